"""Hurcules/Valve-v0: a hand turns a round valve."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules import models
from hurcules_envs.contact import ContactEnvironment, stiffen_fingers, view
from hurcules_envs.environment import Array, Group, Numbers, Start
from hurcules_envs.standing import SUPPORT, place_hands, settle

__all__ = ["Valve"]

WANTED = math.pi / 2  # [rad]
HAND = (0.92, -0.20, 1.05)  # [m] the right tcp at the start
WHEEL = (1.06, -0.15, 1.05)  # [m] middle of the wheel, on average
RADIUS = 0.085  # [m] from the axle, where there is room for fingers between the spokes
SPOKES = 3
CLOSED = 0.05  # [m] way of a finger
DEPTH = 0.015  # [m] the tcp behind the wheel's plane: the tips are 45 mm behind it


class Valve(ContactEnvironment):
    """The right hand of the manipulation robot turns a wheel of 0.30 m by 90 degrees.

    The wheel faces the robot and opens counterclockwise as the robot sees it. The hand keeps its
    orientation, fingers ahead: closed they fit between two spokes and push one of them round. Place
    of the valve, angle of its spokes, friction at its axle and of its surface differ between
    episodes, the robot does not. Success ends an episode.

    Actions, in [-1, 1]; zero holds hand and fingers:

    | index | name | scale | unit | what |
    |---|---|---|---|---|
    | 0 | hand_x | 0.2 | m/s | reference of the hand, forward |
    | 1 | hand_y | 0.2 | m/s | to the left |
    | 2 | hand_z | 0.2 | m/s | up |
    | 3 | grip | 0.05 | m/s | closes the fingers |

    Observation, in the world's axes (x forward, y left, z up):

    | index | name | bound | unit | what |
    |---|---|---|---|---|
    | 0-2 | hand | 1 | m | from the middle of the wheel to the hand (tcp) |
    | 3-5 | velocity | 2 | m/s | of the hand |
    | 6-8 | lead | 0.5 | m | reference minus hand |
    | 9 | fingers | 0.1 | m | that each has closed, of 0.05 |
    | 10-11 | spokes | 1 |  | cosine and sine of three times the angle of a spoke |
    | 12 | turned | 10 | rad | angle of the wheel since the start |
    | 13 | rate | 10 | rad/s | of the wheel |
    | 14 | force | 2000 | N | sum of the normal forces on the hand |

    The angle of a spoke counts counterclockwise from the right, as the robot sees it.

    Reward:

    | term | what |
    |---|---|
    | distance | minus the distance to the ring between hub and rim [m], until success |
    | fingers | 20 times what each finger closed in this step [m] |
    | turned | 5 times the angle turned in this step [rad] |
    | success | 10 once |
    """

    task_description = "Open the valve: turn the wheel by 90 degrees counterclockwise."
    terms = ("distance", "fingers", "turned", "success")
    observation = (
        Group("hand", 3, "m", 1.0, "from the middle of the wheel to the hand"),
        Group("velocity", 3, "m/s", 2.0, "of the hand"),
        Group("lead", 3, "m", 0.5, "reference minus hand"),
        Group("fingers", 1, "m", 0.1, "that each has closed"),
        Group("spokes", 2, "", 1.0, "cosine and sine of three times the angle of a spoke"),
        Group("turned", 1, "rad", 10.0, "angle of the wheel since the start"),
        Group("rate", 1, "rad/s", 10.0, "of the wheel"),
        Group("force", 1, "N", 2000.0, "sum of the normal forces on the hand"),
    )
    memory: Mapping[str, int] = MappingProxyType(
        {"place": 3, "torque": 1, "friction": 1, "angle": 1}
        | {"turned": 1, "gain": 1, "fresh": 1, "fingers": 1, "closing": 1}
    )
    parameters = ("place", "torque", "friction")
    beside: Mapping[str, float | Array] = MappingProxyType({"grip": 0.05})
    quantities = (
        "position/R_tcp", "velocity/R_tcp", "target/hand", "value/hand", "joint/R_grip_1",
        "joint/valve_wheel", "joint_velocity/valve_wheel", "contact_force/R_hand",
    )  # fmt: skip

    def _build(self, model: mujoco.MjModel, tick: float) -> None:
        self.units = {"hand": "m/s", "grip": "m/s"}
        self.actions = {"hand": 0.2, "grip": 0.05}
        self._geoms = [
            i for i in range(model.ngeom) if model.geom_bodyid[i] == model.body("valve_wheel").id
        ]
        plan = place_hands(model, {"R": np.array(HAND)})
        rest = settle(self._loop(plan, tick, safe=False))
        self.simulation = self._loop(rest, tick, safe=self.safe)
        self._wheel = model.joint("valve_wheel").qposadr[0]

    def scene(self) -> mujoco.MjSpec:
        """The robot stands before a valve that can be moved as a whole."""
        spec = models.parse([models.path("manipulation"), models.path("flat")], "valve")
        child = mujoco.MjSpec.from_file(str(models.folder() / "objects" / "valve.xml"))
        body = spec.worldbody.add_body(name="valve", pos=[WHEEL[0], WHEEL[1], 0.0])
        spec.attach(child, prefix="valve_", frame=body.add_frame())
        stiffen_fingers(spec)
        return spec

    def _loop(self, plan: hurcules.Robot, tick: float, *, safe: bool) -> Any:
        hand = hurcules.PositionTask("hand", plan, "R_tcp")
        hand.max_lead = 0.1
        turn = hurcules.OrientationTask("turn", plan, "R_tcp")
        controller = self.controller(
            plan,
            [hand, turn, hurcules.PostureTask("posture", plan)],
            {"hand": hurcules.Twist(hand, 0.2), "grip": hurcules.JointRate("R_grip_1", 0.05)},
            dt=tick,
            safe=safe,
            support=SUPPORT,
        )
        return self.loop(controller)

    def configure(self, model: mujoco.MjModel, values: Mapping[str, Array]) -> None:
        """Place of the valve, friction at its axle [N m] and of the wheel's surface."""
        model.body("valve").pos[:] = [values["place"][0], values["place"][1], values["place"][2]]
        model.body("valve").pos[2] -= WHEEL[2]
        model.joint("valve_wheel").frictionloss[0] = values["torque"][0]
        model.geom_friction[self._geoms, 0] = values["friction"][0]

    def start(self, generator: np.random.Generator) -> Start:
        """A valve before the hand, its spokes anyhow."""
        place = np.array(WHEEL) + generator.uniform([-0.03, -0.06, -0.08], [0.03, 0.06, 0.08])
        angle = generator.uniform(0.0, 2 * math.pi / SPOKES)
        qpos = np.array(self.simulation.data.qpos)
        qpos[self._wheel] = angle
        drawn = {
            "torque": generator.uniform(2.0, 15.0),
            "friction": generator.uniform(0.3, 1.0),
        }
        places = dict(zip(("valve_x", "valve_y", "valve_z"), map(float, place), strict=True))
        return Start(qpos, {"place": place, "angle": angle} | drawn, drawn | places)

    def remember(self, numbers: Numbers) -> None:
        """How far the wheel has turned and the fingers are closed; how much of it in this step."""
        memory = numbers.memory
        before = memory["turned"].copy()
        memory["turned"][:] = numbers["joint/valve_wheel"] - numbers["angle"]
        memory["gain"][:] = memory["turned"] - before
        fingers = numbers["joint/R_grip_1"]
        memory["closing"][:], memory["fingers"][:] = fingers - memory["fingers"], fingers
        memory["fresh"][:] = (memory["turned"] >= WANTED) & (before < WANTED)

    def observe(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        # the first spoke stands straight up where the joint is at 0
        spoke = SPOKES * (numbers["joint/valve_wheel"] + math.pi / 2)
        return {
            "hand": self._hand(numbers),
            "velocity": numbers["velocity/R_tcp"],
            "lead": numbers["target/hand"] - numbers["value/hand"],
            "fingers": numbers["joint/R_grip_1"],
            "spokes": np.concatenate([np.cos(spoke), np.sin(spoke)], axis=1),
            "turned": numbers["turned"],
            "rate": numbers["joint_velocity/valve_wheel"],
            "force": numbers["contact_force/R_hand"],
        }

    def reward(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        shaped = 0.0 if self.sparse else 1.0
        hand = self._hand(numbers)
        ring = np.hypot(hand[:, 1], hand[:, 2]) - RADIUS
        distance = np.hypot(ring, hand[:, 0] - DEPTH)
        return {
            "distance": -shaped * np.where(self.succeeded(numbers), 0.0, distance),
            "fingers": 20.0 * shaped * numbers["closing"][:, 0],
            "turned": 5.0 * shaped * numbers["gain"][:, 0],
            "success": 10.0 * numbers["fresh"][:, 0],
        }

    def succeeded(self, numbers: Numbers) -> NDArray[np.bool_]:
        """The wheel was turned by 90 degrees."""
        return numbers["turned"][:, 0] >= WANTED

    def expert(self, numbers: Numbers) -> Array:
        """Closes the fingers, puts them behind a spoke, and leads it round."""
        seen = self.observe(numbers)
        hand = seen["hand"]
        right, up = -hand[:, 1], hand[:, 2]
        angle = np.arctan2(up, right)
        inside = hand[:, 0] > DEPTH - 0.03
        # the spoke ahead, from 0 to 120 degrees; fingers go in 45 degrees before one
        third = 2 * math.pi / SPOKES
        spoke = np.arctan2(seen["spokes"][:, 1], seen["spokes"][:, 0]) / SPOKES
        ahead = np.mod(spoke - angle, third)
        before = angle + ahead - math.radians(50.0)
        aim = np.where(inside, angle + 0.35, before)
        goal = RADIUS * np.stack([np.cos(aim), np.sin(aim)], axis=1)
        error = goal - np.stack([right, up], axis=1)
        over = np.linalg.norm(error, axis=1) < 0.012
        closed = seen["fingers"][:, 0] > 0.9 * CLOSED
        depth = np.where(inside | (over & closed), DEPTH, -0.08) - hand[:, 0]
        wish = 10.0 * np.stack([depth, -error[:, 0], error[:, 1]], axis=1) / 0.2
        wish = np.where(inside[:, None], np.clip(wish, -0.6, 0.6), np.clip(wish, -1.0, 1.0))
        return np.concatenate([wish, np.ones((len(wish), 1))], axis=1)

    def camera(self) -> mujoco.MjvCamera:
        """From behind on the right, over the arm."""
        return view((0.95, -0.15, 1.05), 1.6, 50.0, -12.0)

    def _hand(self, numbers: Numbers) -> Array:
        return numbers["position/R_tcp"] - numbers["place"]
