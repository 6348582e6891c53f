"""The missions `lift` and `casualty`: the rescue robot lifts a person.

In `lift` it holds him and lays him down again, in `casualty` it lays him on its bed and drives off.
The phases stand in models/missions/lift.toml and casualty.toml, the controller that they command in
cpp/hurcules/mission/table_controllers.cpp; here is the person.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import mujoco

from hurcules import _core, mjcf, scenes
from hurcules._core import WholeBodyController
from hurcules.mission_options import in_words_of, pair, read_options, record, require_offset
from hurcules.mission_table import Mission

__all__ = [
    "MISSIONS",
    "Person",
    "controller",
    "mission",
    "model",
    "parameters_of",
    "person",
    "spec",
]

MISSIONS = ("lift", "casualty")
CONTROLLER = "lift"
SUPPORT = "lower_leg_L"
START = _core.lift_start()
DISTANCE = 3.30  # [m] of the person's middle from the knee axis: 1 m for the approach


@dataclass(frozen=True)
class Person:
    """Who lies there, and how.

    Attributes:
        mass: [kg] 50, 75, 90 or 120.
        offset: [m] from where the robot expects the middle: ahead, and to the left.
        yaw: [rad] turned against where it expects the person.
        friction: of the clothes on the ground.
        pose: on the "back", "left" side, "front" or "right" side.
    """

    mass: int = 75
    offset: tuple[float, float] = (0.0, 0.0)
    yaw: float = 0.0
    friction: float = 0.45
    pose: str = "back"


def person(parameters: Mapping[str, Any]) -> Person:
    """A person from parameters by name; the others keep their defaults.

    Raises:
        Error: no such parameter, or an offset that is not two numbers.
    """
    made = record(Person, "person", parameters)
    require_offset("person", made.offset)
    return made


def parameters_of(words: Sequence[str]) -> dict[str, Any]:
    """What a command line says of the person: `--mass 90 --offset 0.05,-0.1 --yaw 0.2`.

    Raises:
        Error: another option, or a value that is none.
    """
    return read_options(words, _OPTIONS)


_OPTIONS: Mapping[str, Callable[[str], Any]] = {
    "--mass": int,
    "--offset": pair,
    "--yaw": float,
    "--friction": float,
    "--pose": str,
}


def model(person: Person) -> mujoco.MjModel:
    """The robot, and the person across its way, the head to its left.

    Raises:
        Error: a person that there is not.
    """
    return spec(person).compile()


def spec(person: Person) -> mujoco.MjSpec:
    """The same, not compiled yet."""
    dx, dy = person.offset
    with in_words_of({"lying": "pose", "heading": "yaw", "cloth": "friction"}):
        return scenes.make(
            "casualty",
            robot="rescue",
            mass=person.mass,
            lying=person.pose,
            distance=DISTANCE + dx,
            lateral=dy,
            heading=person.yaw,
            cloth=person.friction,
        )


def mission(name: str = "lift") -> Mission:
    """The phases of models/missions/NAME.toml, one of `MISSIONS`."""
    return Mission.load(mjcf.folder() / "missions" / f"{name}.toml")


def controller(model: mujoco.MjModel) -> WholeBodyController:
    """Stacks `arms`, `press` (force control downwards) and `posture`, with a channel a task.

    Channel `joints` moves all joints but the belts one by one.

    Its robot stands at the start.
    """
    return _core.table_controller(CONTROLLER, model)
