"""The missions that are tables of phases: their scenes, tables and controllers, by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import mujoco

from hurcules import _core, disposal, lift
from hurcules._core import Error
from hurcules.mission_table import Mission
from hurcules.validation import require_known, told_at

__all__ = ["TABLE_MISSIONS", "TableMission", "table_mission", "write_table"]


@dataclass(frozen=True)
class TableMission:
    """What a run of such a mission is made of.

    Attributes:
        table: its phases.
        spec: its scene, from parameters by name.
        complete: parameters by name, with the defaults of those that are not given.
        controller: name of that in C++, `_core.table_controller`.
        parameters_of: what the words of a command line say of it.
        followed: the body that a film goes with, and from how far [m].
        carried: the body that its second picture goes with, and what that shows.
    """

    table: Callable[[], Mission]
    spec: Callable[[Mapping[str, Any]], mujoco.MjSpec]
    complete: Callable[[Mapping[str, Any]], dict[str, Any]]
    controller: str
    parameters_of: Callable[[Sequence[str]], dict[str, Any]]
    followed: tuple[str, float]
    carried: tuple[str, str]


def _lifted(name: str) -> TableMission:
    return TableMission(
        partial(lift.mission, name),
        lambda parameters: lift.spec(lift.person(parameters, name)),
        lambda parameters: asdict(lift.person(parameters, name)),
        lift.CONTROLLER,
        partial(lift.parameters_of, name=name),
        ("casualty_pelvis", 3.8),
        ("casualty_pelvis", "from his head's side"),
    )


TABLE_MISSIONS: Mapping[str, TableMission] = {
    **{name: _lifted(name) for name in lift.MISSIONS},
    disposal.NAME: TableMission(
        disposal.mission,
        lambda parameters: disposal.spec(disposal.job(parameters)),
        lambda parameters: asdict(disposal.job(parameters)),
        disposal.NAME,
        disposal.parameters_of,
        ("pelvis", 5.2),
        ("ordnance_case", "the case"),
    ),
}


def table_mission(name: str) -> TableMission | None:
    """A mission by its name, or by the path of a table of your own.

    Args:
        name: one of `TABLE_MISSIONS`, or a TOML file. What the file does not say, scene, controller
            and options, is that of the mission that it names as `scene`.

    Returns:
        None for any other name.

    Raises:
        Error: a file that cannot be read, see `Mission.load`, or a scene that does not exist.
    """
    if not name.endswith(".toml"):
        return TABLE_MISSIONS.get(name)
    table = Mission.load(name)
    scene = table.scene or table.setup.name
    if not table.scene and scene not in TABLE_MISSIONS:
        known = ", ".join(TABLE_MISSIONS)
        raise Error(
            f"{name}: '{scene}' has no scene; [mission] wants scene, one of {known}; a robot of "
            "your own: hurcules.Simulation(hurcules.Mission.load(...), model=..., controller=...), "
            "in a file of Python that hurcules run takes too; its table for C++: Mission.save_table"
        )
    require_known(f"{name}: scene", scene, TABLE_MISSIONS)
    return replace(TABLE_MISSIONS[scene], table=lambda: table)


def write_table(
    name: str, mission: TableMission, parameters: Mapping[str, Any], path: Path
) -> None:
    """Writes what `hurcules-sim` runs a mission from: the table, and beside it the compiled model.

    Args:
        name: of the mission, or of its file, for errors.
        mission: what is run.
        parameters: of its scene, by name.
        path: of the table; the model has its name with the ending `.mjb`.

    Raises:
        Error: a scene that there is not, or a table that does not fit it.
        WriteError: a file cannot be written.
    """
    table, model = mission.table(), mission.spec(parameters).compile()
    controller = _core.table_controller(mission.controller, model)
    data = mujoco.MjData(model)
    with told_at(name):  # what does not run is told now
        _core.Simulation(model, data, controller, table.rows, table.setup)
    table.save_table(path, model, mission.controller)
