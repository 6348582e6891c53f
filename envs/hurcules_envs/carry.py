"""Hurcules/Carry-v0: two hands lift a box between them and bring it to a goal."""

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
from hurcules_envs.contact import (
    ContactEnvironment,
    add_force_sensor,
    box_mark,
    view,
)
from hurcules_envs.environment import Array, Group, Numbers, Start
from hurcules_envs.standing import SUPPORT, place_hands, settle

__all__ = ["Carry"]

TABLE = (0.85, 0.85)  # [m] where its middle is ahead, and how high its top
PALM = 0.10  # [m] of the tcp before the place of the palm that the box comes to
HALF_HAND = 0.06  # [m] of the palm across
APART, HEIGHT = 0.34, 0.97  # [m] of the tcps from the middle, above the ground, at the start
CLOSED = 0.05  # [m] of the fingers
MOST = 600.0  # [N] full scale of the squeeze
CLOSING = 0.1  # [m/s] at which the hands close until they feel the box
FEELS = 5.0  # [N]
NEAR, TURNED, HOLD = 0.03, math.radians(5.0), 0.5  # [m], [rad], [s] of the goal
DROPPED = 0.05  # [m] below its start
COMPLIANCE, STIFFEST = 2e-4, 3e4  # [m/s/N] of the squeeze, [N/m] of the arms


class Carry(ContactEnvironment):
    """Both hands of the manipulation robot squeeze a box, lift it and bring it to a goal.

    A command moves the box, not the hands: they follow its twist as if they were part of it. The
    right hand keeps the squeeze as a force across; both close until they feel the box where a
    squeeze is asked for, and open where it is negative. Size, mass (5 to 60 kg), friction (0.8 to
    1) and place of the box and the goal differ between episodes, the robot does not. An episode
    ends with success when the box was within 30 mm and 5 degrees of its goal for 0.5 s, and fails
    when it is dropped (50 mm below where it stood, or tilted by 60 degrees).

    Actions, in [-1, 1]; zero holds the hands, and asks for no squeeze:

    | index | name | scale | unit | what |
    |---|---|---|---|---|
    | 0 | box_vx | 0.15 | m/s | forward |
    | 1 | box_vy | 0.15 | m/s | to the left |
    | 2 | box_vz | 0.15 | m/s | up |
    | 3 | box_wx | 0.3 | rad/s | about the middle between the hands |
    | 4 | box_wy | 0.3 | rad/s | the same |
    | 5 | box_wz | 0.3 | rad/s | the same |
    | 6 | squeeze | 600 | N | of the right hand to the left |

    Observation, in the world's axes (x forward, y left, z up):

    | index | name | bound | unit | what |
    |---|---|---|---|---|
    | 0-2 | left | 1 | m | from the box to the left hand (palm) |
    | 3-5 | right | 1 | m | from the box to the right hand |
    | 6-8 | way | 2 | m | from the box to its goal |
    | 9-11 | turn | 4 | rad | rotation vector from the box to its goal |
    | 12-14 | velocity | 2 | m/s | of the middle between the hands |
    | 15-16 | forces | 2000 | N | across, of the left and the right hand, towards the box |
    | 17 | raised | 2 | m | of the box since the start |
    | 18-20 | size | 1 | m | half sizes of the box |

    Reward:

    | term | what |
    |---|---|
    | gap | minus the mean distance of the palms to the sides of the box [m] |
    | way | minus the distance of the box to its goal [m] |
    | turn | minus 0.1 of its angle to the goal [rad] |
    | held | 1 while it is at its goal |
    | success | 10 once |
    """

    task_description = "Squeeze the box between both hands, lift it and bring it to its goal."
    terms = ("gap", "way", "turn", "held", "success")
    observation = (
        Group("left", 3, "m", 1.0, "from the box to the left hand"),
        Group("right", 3, "m", 1.0, "from the box to the right hand"),
        Group("way", 3, "m", 2.0, "from the box to its goal"),
        Group("turn", 3, "rad", 4.0, "rotation vector from the box to its goal"),
        Group("velocity", 3, "m/s", 2.0, "of the middle between the hands"),
        Group("forces", 2, "N", 2000.0, "across, of the left and the right hand"),
        Group("raised", 1, "m", 2.0, "of the box since the start"),
        Group("size", 3, "m", 1.0, "half sizes of the box"),
    )
    memory: Mapping[str, int] = MappingProxyType(
        {"size": 3, "mass": 1, "friction": 1, "stood": 1, "goal": 3, "yaw": 1}
        | {"held": 1, "done": 1, "fresh": 1}
    )
    parameters = ("size", "mass", "friction")
    components: Mapping[str, tuple[str, ...]] = MappingProxyType(
        {
            "box": ("box_vx", "box_vy", "box_vz", "box_wx", "box_wy", "box_wz"),
            "squeeze": ("squeeze",),
        }
    )
    quantities = (
        "position/L_tcp", "position/R_tcp", "matrix/L_tcp", "matrix/R_tcp", "velocity/L_tcp",
        "velocity/R_tcp", "target/left", "position/box", "matrix/box", "sensor/L_feel",
        "sensor/R_feel",
    )  # fmt: skip

    def _build(self, model: mujoco.MjModel, tick: float) -> None:
        self.actions = {"box": np.array([0.15] * 3 + [0.3] * 3), "squeeze": MOST}
        places = {
            side: np.array([TABLE[0] + PALM, y, HEIGHT])
            for side, y in (("L", APART), ("R", -APART))
        }
        closed = {f"{side}_grip_{i}": CLOSED for side in "LR" for i in "12"}
        plan = place_hands(model, places, closed)
        self.simulation = self._loop(model, settle(self._loop(model, plan, tick)), tick)
        self._box = model.joint("box").qposadr[0]
        self._scratch = mujoco.MjData(model)

    def scene(self) -> mujoco.MjSpec:
        """The robot stands behind a table with a box on it."""
        spec = models.parse([models.path("manipulation"), models.path("flat")], "carry")
        spec.worldbody.add_geom(
            spec.find_default("terrain"), name="table", type=mujoco.mjtGeom.mjGEOM_BOX,
            size=[0.10, 0.14, TABLE[1] / 2], pos=[TABLE[0], 0.0, TABLE[1] / 2],
        )  # fmt: skip
        box = spec.worldbody.add_body(name="box", pos=[TABLE[0], 0.0, TABLE[1] + 0.11])
        box.add_freejoint(name="box")
        box.add_geom(
            spec.find_default("object"), name="box", type=mujoco.mjtGeom.mjGEOM_BOX,
            size=[0.06, 0.21, 0.11], mass=20.0, rgba=[0.62, 0.45, 0.25, 1.0],
        )  # fmt: skip
        for side in "LR":
            add_force_sensor(spec, f"{side}_feel", f"{side}_wr2")
        return spec

    def _loop(self, model: mujoco.MjModel, plan: hurcules.Robot, tick: float) -> Any:
        left = hurcules.PositionTask("left", plan, "L_tcp")
        right = hurcules.PositionTask("right", plan, "R_tcp", axes=[[1, 0, 0], [0, 0, 1]])
        squeeze = hurcules.ForceTask(
            "squeeze", plan, "R_tcp", axis=[0.0, 1.0, 0.0], force_des=0.0, environment=STIFFEST,
            gains=hurcules.ForceGains(compliance=COMPLIANCE, dt=tick),
            contact=hurcules.ContactOptions(f_min=FEELS, f_max=2000.0),
        )  # fmt: skip
        turns = {
            side: hurcules.OrientationTask(f"{side} turn", plan, f"{side}_tcp") for side in "LR"
        }
        for task in (left, right, squeeze):
            task.max_lead = 0.1
        controller = self.controller(
            plan,
            [[left, right, squeeze, *turns.values()], hurcules.PostureTask("posture", plan)],
            {
                "left": hurcules.Twist(left, 0.3),
                "right": hurcules.Twist(right, 0.3),
                "across": hurcules.Twist(squeeze, 0.3),
                "squeeze": hurcules.ForceReference(squeeze, 1500.0),
                "left_turn": hurcules.Twist(turns["L"], 0.6),
                "right_turn": hurcules.Twist(turns["R"], 0.6),
            },
            dt=tick,
            support=SUPPORT,
            servo=hurcules.servo_table("manipulation"),
        )
        simulation = hurcules.Simulation(model=model, controller=controller, record=False)
        controller.sense(squeeze, "R_feel", row=2)
        return simulation

    def configure(self, model: mujoco.MjModel, values: Mapping[str, Array]) -> None:
        """Half sizes, mass and friction of the box."""
        size, mass = values["size"], values["mass"][0]
        geom, body = model.geom("box"), model.body("box")
        geom.size[:] = size
        model.geom_rbound[geom.id], model.geom_aabb[geom.id, 3:] = np.linalg.norm(size), size
        model.bvh_aabb[model.body_bvhadr[body.id], 3:] = size
        geom.friction[0] = values["friction"][0]
        body.mass[0] = mass
        squares = size**2
        body.inertia[:] = mass / 3.0 * (squares.sum() - squares)
        mujoco.mj_setConst(model, self._scratch)

    def command(self, action: Mapping[str, Array], numbers: Numbers) -> Mapping[str, Array]:
        """The twist of the box, for both hands, and the squeeze for the right one."""
        if self.action == "joint":
            return action
        v, w, squeeze = action["box"][:, :3], action["box"][:, 3:], action["squeeze"]
        lever = 0.5 * (self._palm(numbers, "L") - self._palm(numbers, "R"))
        left, right = v + np.cross(w, lever), v - np.cross(w, lever)
        closing = CLOSING * np.clip(squeeze[:, 0] / 100.0, -1.0, 1.0)
        forces = self._forces(numbers)
        left[:, 1] -= np.where((closing < 0.0) | (forces[:, 0] < FEELS), closing, 0.0)
        across = right[:, 1:2] + closing[:, None]  # not where it feels the box: there force rules
        return {
            "left": left,
            "right": right[:, [0, 2]],
            "across": across,
            # a first-order force law moves by C (f_des - f): what the box's motion takes is added
            "squeeze": np.maximum(squeeze, 0.0) + right[:, 1:2] / COMPLIANCE,
            "left_turn": w,
            "right_turn": w,
        }

    def start(self, generator: np.random.Generator) -> Start:
        """A box on the table, and where it is wanted."""
        size = generator.uniform([0.05, 0.19, 0.09], [0.06, 0.25, 0.14])
        x, y = TABLE[0] + generator.uniform(-0.02, 0.02), generator.uniform(-0.02, 0.02)
        place = np.array([x, y, TABLE[1] + size[2]])
        qpos = np.array(self.simulation.data.qpos)
        qpos[self._box : self._box + 7] = [*place, 1.0, 0.0, 0.0, 0.0]
        drawn = {"mass": generator.uniform(5.0, 60.0), "friction": generator.uniform(0.8, 1.0)}
        goal = place + generator.uniform([0.0, -0.06, 0.08], [0.10, 0.06, 0.25])
        yaw = generator.uniform(-0.2, 0.2)
        memory = {"size": size, "stood": place[2], "goal": goal, "yaw": yaw}
        sizes = dict(zip(("half_x", "half_y", "half_z"), map(float, size), strict=True))
        return Start(qpos, memory | drawn, drawn | sizes)

    def remember(self, numbers: Numbers) -> None:
        """For how long the box has been at its goal."""
        memory = numbers.memory
        held = memory["held"]
        held[:, 0] = np.where(self._at_goal(numbers), held[:, 0] + numbers.dt, 0.0)
        before = memory["done"].copy()
        memory["done"][held >= HOLD - 1e-9] = 1.0
        memory["fresh"][:] = memory["done"] - before

    def observe(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        box = numbers["position/box"]
        return {
            "left": self._palm(numbers, "L") - box,
            "right": self._palm(numbers, "R") - box,
            "way": numbers["goal"] - box,
            "turn": self._turn(numbers),
            "velocity": 0.5 * (numbers["velocity/L_tcp"] + numbers["velocity/R_tcp"]),
            "forces": self._forces(numbers),
            "raised": box[:, 2:] - numbers["stood"],
            "size": numbers["size"],
        }

    def reward(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        shaped = 0.0 if self.sparse else 1.0
        seen = self.observe(numbers)
        side = np.zeros_like(seen["size"])
        side[:, 1] = seen["size"][:, 1] + HALF_HAND
        gap = np.linalg.norm(seen["left"] - side, axis=1)
        gap += np.linalg.norm(seen["right"] + side, axis=1)
        return {
            "gap": -0.5 * shaped * gap,
            "way": -shaped * np.linalg.norm(seen["way"], axis=1),
            "turn": -0.1 * shaped * np.linalg.norm(seen["turn"], axis=1),
            "held": self._at_goal(numbers).astype(np.float64),
            "success": 10.0 * numbers["fresh"][:, 0],
        }

    def succeeded(self, numbers: Numbers) -> NDArray[np.bool_]:
        """The box was at its goal for half a second."""
        return numbers["done"][:, 0] > 0.0

    def failed(self, numbers: Numbers) -> NDArray[np.bool_]:
        """The box fell."""
        fallen = numbers["position/box"][:, 2] < numbers["stood"][:, 0] - DROPPED
        return fallen | (numbers["matrix/box"][:, 8] < 0.5)

    def expert(self, numbers: Numbers) -> Array:
        """Squeezes, lifts, then goes to the goal; the hands stay level with the box."""
        seen = self.observe(numbers)
        up = seen["raised"][:, 0]
        holds = (seen["forces"][:, 1] > 0.85 * SQUEEZE) | (up > 0.003)
        raised = up > 0.03
        middle = 0.5 * (seen["left"] + seen["right"])
        way = np.clip(1.5 * seen["way"], -0.06, 0.06)
        way[~raised, :2] = 0.0
        way[~raised, 2] = 0.05
        twist = np.where(holds[:, None], way, -2.0 * middle)
        twist[:, 1] = np.where(holds, twist[:, 1], 0.0)
        spin = np.where((holds & raised)[:, None], np.clip(seen["turn"], -0.12, 0.12), 0.0)
        squeeze = np.full((len(twist), 1), SQUEEZE / MOST)
        action = np.concatenate([twist / 0.15, spin / 0.3, squeeze], axis=1)
        return np.clip(action, -1.0, 1.0)

    def camera(self) -> mujoco.MjvCamera:
        """From the front on the left."""
        return view((0.65, 0.0, 1.0), 2.6, 215.0, -15.0)

    def draw(self, episodes: Any, i: int, scene: mujoco.MjvScene) -> None:
        """The goal as a green box one sees through."""
        memory = {name: values[i] for name, values in episodes.memory.items()}
        box_mark(scene, memory["goal"], memory["size"], _yawed(memory["yaw"])[0], GREEN)

    def _palm(self, numbers: Numbers, side: str) -> Array:
        """(n, 3) [m] middle of a palm in the world."""
        ahead = numbers[f"matrix/{side}_tcp"].reshape(-1, 3, 3)[:, :, 0]
        return numbers[f"position/{side}_tcp"] - PALM * ahead

    def _forces(self, numbers: Numbers) -> Array:
        """(n, 2) [N] of the left and the right hand, across, towards the box."""
        return np.stack([-numbers["sensor/L_feel"][:, 2], numbers["sensor/R_feel"][:, 2]], axis=1)

    def _turn(self, numbers: Numbers) -> Array:
        """(n, 3) [rad] rotation vector, in the world, that brings the box to its goal."""
        wanted = _yawed(numbers["yaw"][:, 0])
        R = wanted @ numbers["matrix/box"].reshape(-1, 3, 3).transpose(0, 2, 1)
        return _rotation_vectors(R)

    def _at_goal(self, numbers: Numbers) -> NDArray[np.bool_]:
        near = np.linalg.norm(numbers["goal"] - numbers["position/box"], axis=1) < NEAR
        return near & (np.linalg.norm(self._turn(numbers), axis=1) < TURNED)


SQUEEZE = 450.0  # [N] of the expert: 60 kg at friction 0.8 want 370
GREEN = (0.1, 0.8, 0.2, 0.35)


def _yawed(yaw: Array) -> Array:
    """(n, 3, 3) turns about z."""
    c, s = np.cos(np.atleast_1d(yaw)), np.sin(np.atleast_1d(yaw))
    o = np.zeros_like(c)
    return np.stack([c, -s, o, s, c, o, o, o, o + 1.0], axis=1).reshape(-1, 3, 3)


def _rotation_vectors(R: Array) -> Array:
    """(n, 3) [rad] of rotations (n, 3, 3) by less than half a turn."""
    axis = np.stack(
        [R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]], axis=1
    )
    sine = 0.5 * np.linalg.norm(axis, axis=1)
    angle = np.arctan2(sine, 0.5 * (np.trace(R, axis1=1, axis2=2) - 1.0))
    share = np.where(sine > 1e-9, angle / np.maximum(2.0 * sine, 1e-9), 0.5)
    return share[:, None] * axis
