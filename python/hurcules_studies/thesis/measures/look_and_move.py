"""H18: look and move: from the estimated pose of an object to a grasp, without an operator.

A case of 30 kg with a handle lies near the left hand of the manipulation robot, which stands in its
acquisition posture. The pose that the robot is told has the error of a stereo estimate. From it
alone RHQP leads the hand above the handle and down to it, in the closed loop; the fingers close,
RHQP leads it up. Friction alone holds the handle.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import mujoco
import numpy as np

import hurcules
from hurcules import _core, models, postures
from hurcules_studies.thesis.claim import Finding, Line, Note, Plot, line
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures
from hurcules_studies.thesis.measures.whole_body import DT, Body

TRIES = 6
HANDLE = 0.093  # [m] above the ground: where the hand is in the acquisition posture
PLACES = np.array([0.06, 0.05, 0.25])  # [m], [m], [rad] of the case, either way
# stereo of 0.12 m base at 1.5 m, half a pixel of 1280 over 60 degrees: 8 mm along, 1 mm across
ESTIMATE = np.array([0.008, 0.003, 0.02])  # [m], [m], [rad]
ABOVE, RISE = 0.18, 0.45  # [m] over the handle before the grasp; that it is lifted
CLOSED = 0.05  # [m] a finger
UP = np.array([0.0, 0.0, 1.0])


def scene() -> mujoco.MjModel:
    """The robot and the case, which is put into its place later."""
    spec = models.parse([models.path("manipulation"), models.path("flat")], "look and move")
    case = spec.worldbody.add_body(name="case", pos=[5, 0, 0.03])
    case.add_freejoint(name="case")
    box, capsule = mujoco.mjtGeom.mjGEOM_BOX, mujoco.mjtGeom.mjGEOM_CAPSULE
    bits = {"contype": 8, "conaffinity": 15, "friction": [0.6, 0.005, 0.001]}
    case.add_geom(name="case", type=box, size=[0.2, 0.15, 0.03], mass=29.5, **bits)
    top = HANDLE - 0.03
    case.add_geom(
        name="handle", type=capsule, size=[0.018, 0, 0], mass=0.5,
        fromto=[-0.07, 0, top, 0.07, 0, top], **bits,
    )  # fmt: skip
    return spec.compile()


class Hand:
    """RHQP in the loop: moves the left hand in straight lines, between moves of joints.

    Attributes:
        player: of the moves.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        body = Body({}, model=model)
        body.robot.set_keyframe("acquisition")
        body.robot.stand_on("lower_leg_L")
        self._hand = body.tasks["lhpos"]
        self._body = body  # its tasks are the controller's
        channels = {name: hurcules.Twist(body.tasks[name], math.inf) for name in ("lhpos", "lhor")}
        controller = hurcules.WholeBodyController(
            body.robot,
            body.stack(),
            channels,
            feed_forward=False,
            velocity=body.setting.options,
        )
        options = hurcules.SimulationOptions(
            record=False, monitors=hurcules.MonitorOptions(on=False)
        )
        self.data = mujoco.MjData(model)
        simulation = _core.Simulation(model, self.data, controller, options)
        mujoco.mj_forward(model, self.data)
        self.player = postures.Player(model, self.data, ["case"], simulation)

    def straight(self, goal: Array, yaw: float, seconds: float) -> postures.Result:
        """The left hand to a point [m], turned by an angle about the vertical."""
        ticks = round(seconds / DT)
        self.player.controller.use("stack")  # its targets are where the joints were led
        way = np.concatenate([goal - self._hand.target, [0.0, 0.0, yaw]])

        def command(i: int) -> Array:
            rate = (1.0 - math.cos(2.0 * math.pi * (i + 0.5) / ticks)) / seconds
            return np.asarray(rate * way)

        return self.player.rule("hand", ticks, command)


@dataclass(frozen=True)
class Try:
    """One grasp: where the case was (x, y [m], yaw [rad]), and how it went."""

    place: Array
    missed: float  # [m] from the middle between the fingers to the handle, before they close
    height: float  # [m] that the case rose by
    time: Array  # [s]
    hand: Array  # (samples,) [m] height of the hand
    case: Array  # (samples,) [m] of the case
    collisions: int


def put(model: mujoco.MjModel, data: mujoco.MjData, place: Array) -> None:
    """Lays the case down."""
    x, y, yaw = place
    at = model.joint("case").qposadr[0]
    pose = [x, y, 0.03, math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)]
    data.qpos[at : at + 7] = pose
    mujoco.mj_forward(model, data)


def attempt(seed: int) -> Try:
    """Grasps and lifts the case."""
    rng = np.random.default_rng(seed)
    model = scene()
    robot = Hand(model)
    data, player = robot.data, robot.player
    tcp = data.site("L_tcp").xpos.copy()
    collisions = 0

    def move(goal: Array, yaw: float, seconds: float) -> None:
        nonlocal collisions
        collisions += len(robot.straight(goal, yaw, seconds).collisions)

    # the hand is raised before anything lies below it
    player.wait(0.5)
    move(tcp + ABOVE * UP, 0.0, 3.0)
    place = np.array([tcp[0], tcp[1], 0.0]) + PLACES * rng.uniform(-1.0, 1.0, 3)
    put(model, data, place)
    told = place + ESTIMATE * np.clip(rng.standard_normal(3), -2.0, 2.0)
    rows: list[tuple[float, float, float]] = []

    def watch() -> None:
        rows.append((data.time, data.site("L_tcp").xpos[2], data.body("case").xpos[2]))

    player.watch = watch
    handle = np.array([told[0], told[1], HANDLE])
    move(handle + ABOVE * UP, told[2], 3.0)
    move(handle, 0.0, 3.0)
    player.wait(0.5)
    missed = float(np.linalg.norm(data.site("L_tcp").xpos - data.geom("handle").xpos))
    player.play([postures.Move("close", 0.8, ((1.0, {"L_grip_1": CLOSED}),), 1.2)])
    move(handle + RISE * UP, 0.0, 5.0)
    player.wait(1.0)
    log = np.array(rows)
    time, hand, case = log.T
    return Try(place, missed, float(case[-1] - 0.03), time, hand, case, collisions)


@cache
def attempts() -> list[Try]:
    """All of them."""
    return [attempt(seed) for seed in range(TRIES)]


@measures("H18")
def look_and_move() -> Finding:
    """Six cases within 6 cm, 5 cm and 0.25 rad, told with an error of a stereo camera."""
    tries = attempts()

    def drawn(height: Callable[[Try], Array]) -> list[Line]:
        return [
            line(f"{i + 1}", one.time - one.time[0], height(one), "line")
            for i, one in enumerate(tries)
        ]

    return Finding(
        {
            "lifted": sum(one.height > 0.5 * RISE for one in tries),
            "missed": max(one.missed for one in tries),
            "collisions": sum(one.collisions for one in tries),
        },
        [Note("lowest height that a case was lifted to", min(one.height for one in tries), "m")],
        [
            Plot("Left hand", "time [s]", "height [m]", drawn(lambda one: one.hand)),
            Plot("Case", "time [s]", "height [m]", drawn(lambda one: one.case)),
        ],
    )
