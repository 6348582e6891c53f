"""The mission `disposal`: the manipulation robot takes a case with both hands and puts it away.

The phases stand in models/missions/disposal.toml, the controller that they command in
cpp/hurcules/mission/table_controllers.cpp; here are the case and the container.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import mujoco

from hurcules import _core, mjcf, scenes
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

__all__ = ["Job", "controller", "job", "mission", "model", "parameters_of", "spec"]

NAME = "disposal"
DISTANCE = 3.0  # [m] of the case from the knee axis: 1.25 m for the approach


@dataclass(frozen=True)
class Job:
    """What is to be fetched, and where it lies.

    Attributes:
        mass: [kg] of the case.
        offset: [m] from where the robot expects its middle: ahead, and to the left.
        yaw: [rad] turned against where it expects the case.
        friction: of the bars under the fingers.
    """

    mass: float = 20.0
    offset: tuple[float, float] = (0.0, 0.0)
    yaw: float = 0.0
    friction: float = 0.6


def job(parameters: Mapping[str, Any]) -> Job:
    """A job from parameters by name; the others keep their defaults.

    Raises:
        Error: no such parameter, or an offset that is not two numbers.
    """
    made = record(Job, "disposal", parameters)
    require_offset("disposal", made.offset)
    return made


def parameters_of(words: Sequence[str]) -> dict[str, Any]:
    """What a command line says of the job: `--mass 30 --offset 0.05,-0.1 --yaw 0.2`.

    Raises:
        Error: another option, or a value that is none.
    """
    return read_options(words, defaults_of(Job))


def model(job: Job) -> mujoco.MjModel:
    """The robot, the case across its way, and the container behind it.

    Raises:
        Error: a number out of the scene's range.
    """
    return spec(job).compile()


def spec(job: Job) -> mujoco.MjSpec:
    """The same, not compiled yet."""
    dx, dy = job.offset
    words = {"grip": "friction", "heading": "yaw", **away_words(DISTANCE)}
    with in_words_of(words):
        return scenes.make(
            "disposal",
            robot="manipulation",
            mass=job.mass,
            grip=job.friction,
            distance=DISTANCE + dx,
            lateral=dy,
            heading=job.yaw,
        )


def mission() -> Mission:
    """The phases of models/missions/disposal.toml."""
    return Mission.load(mjcf.folder() / "missions" / f"{NAME}.toml")


def controller(model: mujoco.MjModel) -> WholeBodyController:
    """Stacks `hands` (place and direction of both, then pelvis, then posture) and `posture`.

    A channel a task; `joints` moves all joints but belts and fingers one by one, `left_grip` and
    `right_grip` the fingers.

    Its robot stands in the keyframe `drive`.
    """
    return _core.table_controller(NAME, model)
