"""The missions `lift`, `casualty` and `crossing`: the rescue robot lifts a person.

In `lift` it holds him and lays him down again, in `casualty` it lays him on its bed and drives off,
in `crossing` a terrain lies on the way there and home, and the bed has rims. The phases stand in
models/missions, the controller that they command in cpp/hurcules/mission/table_controllers.cpp;
here is the person.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import mujoco

from hurcules import _core, mjcf, scenes, transfer_bed
from hurcules._core import WholeBodyController
from hurcules.mission_options import (
    away_words,
    defaults_of,
    in_words_of,
    read_options,
    record,
    require_offset,
)
from hurcules.mission_table import Mission

__all__ = [
    "MISSIONS",
    "ON_THE_FRONT",
    "Away",
    "Person",
    "controller",
    "mission",
    "model",
    "parameters_of",
    "person",
    "spec",
]

CONTROLLER = "lift"
SUPPORT = "lower_leg_L"
START = _core.lift_start()
DISTANCE = 3.30  # [m] of the person's middle from the knee axis: 1 m for the approach
# phases that only who lies on his front comes to, as he is laid down
ON_THE_FRONT = ("let down", "draw back", "set flat")
NEAR, BEYOND = 1.5, 0.5  # [m] of the knee axis: before the terrain, and behind it


@dataclass(frozen=True)
class Person:
    """Who lies there, and how.

    Attributes:
        mass: [kg] 50, 75, 90 or 120.
        offset: [m] from where the robot expects the middle: ahead, and to the left.
        yaw: [rad] turned against where it expects the person.
        friction: of the clothes on the ground.
        pose: on the "back", "left" side, "front" or "right" side.
        arms: at the "sides", "out" to 80 degrees from the trunk, or "folded" over the belly.
    """

    mass: int = 75
    offset: tuple[float, float] = (0.0, 0.0)
    yaw: float = 0.0
    friction: float = 0.45
    pose: str = "back"
    arms: str = "sides"


@dataclass(frozen=True)
class Away(Person):
    """Who lies beyond a terrain, and what it is.

    Attributes:
        terrain: a "road", rough like those of ISO 8608, or "ramps" that cross each other's way.
        way: [m] across it.
        rise: [m] from its lowest to its highest point.
        ground: a whole number >= 0, draws the road.
    """

    terrain: str = "road"
    way: float = 5.0
    rise: float = 0.10
    ground: int = 0


MISSIONS: Mapping[str, type[Person]] = {"lift": Person, "casualty": Person, "crossing": Away}


def person(parameters: Mapping[str, Any], name: str = "lift") -> Person:
    """A person from parameters by name; the others keep their defaults.

    Args:
        parameters: of the kind of person that the mission has.
        name: of the mission, one of `MISSIONS`.

    Raises:
        Error: no such parameter, or an offset that is not two numbers.
    """
    made = record(MISSIONS[name], "person", parameters)
    require_offset("person", made.offset)
    return made


def parameters_of(words: Sequence[str], name: str = "lift") -> dict[str, Any]:
    """What a command line says of the person: `--mass 90 --offset 0.05,-0.1 --yaw 0.2`.

    Args:
        words: of the command line.
        name: of the mission.

    Raises:
        Error: another option, or a value that is none.
    """
    return read_options(words, defaults_of(MISSIONS[name]))


def model(person: Person) -> mujoco.MjModel:
    """The robot, and the person across its way, the head to its left.

    Raises:
        Error: a person, or a terrain, that there is not.
    """
    return spec(person).compile()


def spec(person: Person) -> mujoco.MjSpec:
    """The same, not compiled yet."""
    dx, dy = person.offset
    terrain, seed, words = {}, 0, away_words(DISTANCE)
    if isinstance(person, Away):
        terrain = {"terrain": person.terrain, "way": person.way, "rise": person.rise, "near": NEAR}
        dx, seed = dx + NEAR + person.way + BEYOND, person.ground
        words = away_words(DISTANCE + NEAR + BEYOND, ", the way")
    words |= {"lying": "pose", "heading": "yaw", "cloth": "friction", "seed": "ground"}
    with in_words_of(words):
        scene = scenes.make(
            "casualty",
            robot="rescue",
            seed=seed,
            **terrain,
            mass=person.mass,
            lying=person.pose,
            arms=person.arms,
            distance=DISTANCE + dx,
            lateral=dy,
            heading=person.yaw,
            cloth=person.friction,
        )
    if isinstance(person, Away):
        transfer_bed.add_rims(scene)
    return scene


def mission(name: str = "lift") -> Mission:
    """The phases of models/missions/NAME.toml, one of `MISSIONS`."""
    return Mission.load(mjcf.folder() / "missions" / f"{name}.toml")


def controller(model: mujoco.MjModel) -> WholeBodyController:
    """Stacks `arms`, `press` (force control downwards) and `posture`, with a channel a task.

    Channel `joints` moves all joints but the belts one by one.

    Its robot stands at the start.
    """
    return _core.table_controller(CONTROLLER, model)
