"""The missions `lift` and `casualty`: the rescue robot lifts a person.

In `lift` it holds him and lays him down again, in `casualty` it lays him on its bed and drives off.
The phases stand in models/missions/lift.toml and casualty.toml; here are the person, the start and
the controller that they command: channels and stacks by their names.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import mujoco

from hurcules import _core, mjcf, scenes
from hurcules._core import (
    AngleTask,
    ContactOptions,
    Drive,
    DriveOptions,
    ForceGains,
    ForceTask,
    JointLimits,
    JointRates,
    PositionTask,
    PostureTask,
    Robot,
    SpringForce,
    Stack,
    Twist,
    WholeBodyController,
)
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
SUPPORT = "lower_leg_L"
# tips 5 cm above the ground, 1.80 m ahead of the knee axis, lower arms 0.12 rad below the level;
# the head looks up, or it would meet the person where the trunk leans by more than 1.2 rad
START = {"KN": 1.763, "HIP": 0.36, "NKP": -1.19, "SP": 1.9645, "EB": 1.2251}
DISTANCE = 3.30  # [m] of the person's middle from the knee axis: 1 m for the approach
SPRING = 1100.0  # [N/m] of the elbows' springs at the tips


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
    robot = Robot(model)
    robot.set_keyframe("stretch")
    robot.stand_on(SUPPORT)
    q, names = robot.configuration, robot.coordinate_names
    for name, angle in START.items():
        for joint in {name, f"L{name}", f"R{name}"} & set(names):
            q[names.index(joint)] = angle
    robot.set_configuration(q)

    limits = JointLimits("joint", robot)
    for name, (lower, upper) in _core.mode_ranges("rescue_ready").items():
        limits.set_range(name, lower, upper)
    level = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    gains = ForceGains(compliance=0.05)
    contact = ContactOptions(f_max=1e4)
    hands = [PositionTask(f"{side}_hand", robot, f"{side}_tcp") for side in "LR"]
    across = [PositionTask(f"{side}_across", robot, f"{side}_tcp", axes=level) for side in "LR"]
    press = [
        ForceTask(
            f"{side}_press", robot, f"{side}_tcp", gains=gains, environment=SPRING, contact=contact
        )
        for side in "LR"
    ]
    pitch = [AngleTask(f"{side}_pitch", robot, f"{side}_tcp") for side in "LR"]
    pelvis = PositionTask("pelvis", robot, "pelvis", axes=[[1.0, 0.0, 0.0]])
    neck = PostureTask("neck", robot, ["NKY", "NKP"])
    posture = PostureTask("posture", robot)
    servo = _core.servo_table("rescue")
    joints = [name for name in servo if not name.endswith("_belt")]
    tasks = [*hands, *across, *press, *pitch, pelvis, neck, posture]
    made = WholeBodyController(
        robot,
        None,
        {task.name: Twist(task, math.inf) for task in tasks}
        | {"drive": Drive(speed=1.0, yaw_rate=0.5), "joints": JointRates(joints)},
        stacks={
            "arms": Stack([limits, hands, pitch, pelvis, neck]),
            "press": Stack([limits, [*across, *press], pitch, pelvis, neck]),
            "posture": Stack([limits, posture]),
        },
        servo=servo,
        drive=DriveOptions(),
    )
    for side, task in zip("LR", press, strict=True):
        made.sense(task, SpringForce(robot, f"{side}EBS", f"{side}_tcp"))
    return made
