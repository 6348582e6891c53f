"""The missions that are tables of phases: their scenes, tables and controllers, by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import mujoco

from hurcules import disposal, lift
from hurcules._core import WholeBodyController
from hurcules.mission_table import Mission

__all__ = ["TABLE_MISSIONS", "TableMission"]


@dataclass(frozen=True)
class TableMission:
    """What a run of such a mission is made of.

    Attributes:
        table: its phases.
        spec: its scene, from parameters by name.
        controller: for the compiled scene.
        parameters_of: what the words of a command line say of it.
        followed: the body that a film goes with, and from how far [m].
        carried: the body that its second picture goes with, and what that shows.
    """

    table: Callable[[], Mission]
    spec: Callable[[Mapping[str, Any]], mujoco.MjSpec]
    controller: Callable[[mujoco.MjModel], WholeBodyController]
    parameters_of: Callable[[Sequence[str]], dict[str, Any]]
    followed: tuple[str, float]
    carried: tuple[str, str]


def _lifted(name: str) -> TableMission:
    return TableMission(
        partial(lift.mission, name),
        lambda parameters: lift.spec(lift.person(parameters)),
        lift.controller,
        lift.parameters_of,
        ("casualty_pelvis", 3.8),
        ("casualty_pelvis", "from his head's side"),
    )


TABLE_MISSIONS: Mapping[str, TableMission] = {
    **{name: _lifted(name) for name in lift.MISSIONS},
    disposal.NAME: TableMission(
        disposal.mission,
        lambda parameters: disposal.spec(disposal.job(parameters)),
        disposal.controller,
        disposal.parameters_of,
        ("pelvis", 5.2),
        ("ordnance_case", "the case"),
    ),
}
