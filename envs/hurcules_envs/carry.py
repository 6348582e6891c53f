"""Hurcules/Carry-v0: two hands lift a box between them and bring it to a goal."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules import models
from hurcules_envs.carrier_search import Wanted, load_carrier
from hurcules_envs.carriers import FEELS, HANDS, Carrier
from hurcules_envs.contact import (
    ContactEnvironment,
    add_force_sensor,
    box_mark,
    resize_box,
    stiffen_fingers,
    view,
)
from hurcules_envs.environment import Array, Group, Numbers, Start
from hurcules_envs.robots import MAX_ACCELERATION
from hurcules_envs.safety import Safety
from hurcules_envs.standing import SUPPORT, place_hands, settle

__all__ = ["Carry"]

TABLE = (0.85, 0.85)  # [m] where its middle is ahead, and how high its top
PALM = 0.10  # [m] of the tcp before the place of the palm that the box comes to
HALF_HAND = 0.06  # [m] of the palm across
APART, HEIGHT = 0.34, 0.97  # [m] of the tcps from the middle, above the ground, at the start
CLOSED = 0.05  # [m] of the fingers
MOST = 600.0  # [N] full scale of the squeeze
CLOSING = 0.1  # [m/s] at which the hands close until they feel the box
FELT = 5.0  # [N]
NEAR, TURNED, HOLD = 0.03, math.radians(5.0), 0.5  # [m], [rad], [s] of the goal
DROPPED = 0.05  # [m] below its start
COMPLIANCE, STIFFEST = 2e-4, 3e4  # [m/s/N] of the squeeze, [N/m] of the arms
RATE = 12.0  # [1/s] at which the squeeze of another robot comes to what is wanted
MASS = (5.0, 60.0)  # [kg] of the box
HALF = np.array([[0.05, 0.19, 0.09], [0.06, 0.25, 0.14]])  # [m] half sizes of the box
ASIDE = 0.02  # [m] of the box from the table's middle
GOAL = np.array([[0.0, -0.06, 0.08], [0.10, 0.06, 0.25]])  # [m] from where the box stands
YAW = 0.2  # [rad] of the goal to either side
# what bends with it keeps so far [m] from the table: it leant on that, and fell
TRUNK, OFF = ("pelvis_drum", "waist_top", "torso", "L_uarm", "R_uarm"), 0.06


class Carry(ContactEnvironment):
    """Both hands of the manipulation robot, or of any other, squeeze a box and bring it to a goal.

    A command moves the box, not the hands: they follow its twist as if they were part of it. The
    right hand keeps the squeeze as a force across; both close until they feel the box where a
    squeeze is asked for, and open where it is negative. Size, mass (5 to 60 kg), friction (0.8 to
    1) and place of the box and the goal differ between episodes, the robot does not. An episode
    ends with success when the box was within 30 mm and 5 degrees of its goal for 0.5 s, and fails
    when it is dropped (50 mm below where it stood, or tilted by 60 degrees).

    A robot of another file (`robot=`, with the frames of its left and its right hand) is read as
    MjSpec, so that table, box, sensors and, before its frames, flat pads can be added. Its base is
    fixed. Table and goals come where both hands reach the box all the way without touching
    anything else; `place=` says where instead. Masses and squeezes are those below times the share
    that its motors bear there, at most 1: `action_scale` and `mass` in `info` have it. Forces are
    observed over that share, so that one policy acts on all; sizes and ways are the same. The
    compliance of the squeeze follows from how far a push moves the hand.

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

    def __init__(
        self,
        fidelity: str = "exact",
        sparse: bool = False,
        rate: float = 20.0,
        action: str = "twist",
        robot: str | Path = "manipulation",
        frames: Sequence[str] | None = None,
        joints: Sequence[str] | None = None,
        palm: str = "z",
        pads: bool = True,
        place: Sequence[float] | None = None,
        safe: bool = True,
    ) -> None:
        """Builds scene, controller and loop.

        Args:
            fidelity: "exact" or "fast".
            sparse: no shaped reward: success and the time at the goal alone.
            rate: steps a second [Hz].
            action: "twist" (what the class says), or "joint" for comparison.
            robot: "manipulation", or the path of an MJCF file.
            frames: of a path: its left and its right hand, bodies or sites.
            joints: of a path: its coordinates.
            palm: of a path: the axis of the frames that looks out of the palms, "x", "-z", ...
            pads: of a path: flat pads 40 mm thick stand before the frames; False: the frames lie in
                the palms' own surfaces.
            place: of a path: x, y, z [m] of the middle of the table's top; None: it is looked for.
            safe: before the hands come the robot's balance and distances of its parts from each
                other and from the ground; False leaves only the limits.

        Raises:
            hurcules.Error: a value that does not exist or is out of range, or a robot that cannot
                carry: the text says why.
        """
        self._own: Carrier | None = None
        if robot == "manipulation":
            given = {"frames": frames, "joints": joints, "place": place}
            for name, value in given.items():
                if value is not None:
                    raise hurcules.Error(
                        f"{name}: robot 'manipulation' has its own; wanted none, got {value!r}"
                    )
            self._hands, self._feels, self._back = ("L_tcp", "R_tcp"), ("L_feel", "R_feel"), PALM
            self._place, self._share = (TABLE[0], 0.0, TABLE[1]), 1.0
        else:
            if robot == "rescue":
                raise hurcules.Error(
                    "robot 'rescue': wanted palms that come to both sides of a box; its lower arms "
                    "are scoops: 'manipulation' or the path of an MJCF file carries"
                )
            own = load_carrier(robot, frames, joints, palm, pads, place, WANTED)
            self._own, self._hands, self._feels, self._back = own, HANDS, FEELS, HALF_HAND
            self._place, self._share, self.support = own.place, own.share, ""
        self._compliance, self._stiffness = COMPLIANCE, STIFFEST
        left, right = self._hands
        self.quantities = (
            f"position/{left}", f"position/{right}", f"matrix/{left}", f"matrix/{right}",
            f"velocity/{left}", f"velocity/{right}", "target/left", "position/box", "matrix/box",
            *(f"sensor/{feel}" for feel in self._feels),
        )  # fmt: skip
        super().__init__(fidelity, sparse, rate, action, safe)

    def _build(self, model: mujoco.MjModel, tick: float) -> None:
        most = MOST * self._share
        self.units = {"box": ("m/s",) * 3 + ("rad/s",) * 3, "squeeze": "N"}
        self.actions = {"box": np.array([0.15] * 3 + [0.3] * 3), "squeeze": most}
        self._box = model.joint("box").qposadr[0]
        self._scratch = mujoco.MjData(model)
        if self._own is not None:
            loop = self._loop(self._own.plan(model), tick, safe=False)
            self._stiffness = self._own.stiffness(loop)
            self._compliance = RATE / self._stiffness
            self.simulation = self._loop(self._own.plan(model), tick, safe=self.safe)
            return
        places = {
            side: np.array([TABLE[0] + PALM, y, HEIGHT])
            for side, y in (("L", APART), ("R", -APART))
        }
        closed = {f"{side}_grip_{i}": CLOSED for side in "LR" for i in "12"}
        plan = place_hands(model, places, closed)
        rest = settle(self._loop(plan, tick, safe=False))
        self.simulation = self._loop(rest, tick, safe=self.safe)

    def scene(self) -> mujoco.MjSpec:
        """The robot stands behind a table with a box on it."""
        if self._own is not None:
            return self._own.scene()
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
        stiffen_fingers(spec)
        return spec

    def _loop(self, plan: hurcules.Robot, tick: float, *, safe: bool) -> Any:
        own, share, compliance = self._own, self._share, self._compliance
        most = 1500.0 if own is None else MOST * share + 0.3 / compliance  # [N] of the channel
        left = hurcules.PositionTask("left", plan, self._hands[0])
        right = hurcules.PositionTask("right", plan, self._hands[1], axes=[[1, 0, 0], [0, 0, 1]])
        squeeze = hurcules.ForceTask(
            "squeeze", plan, self._hands[1], axis=[0.0, 1.0, 0.0], force_des=0.0,
            environment=self._stiffness,
            gains=hurcules.ForceGains(compliance=compliance, dt=tick),
            contact=hurcules.ContactOptions(f_min=FELT * share, f_max=most + 500.0),
        )  # fmt: skip
        turns = {
            side: hurcules.OrientationTask(f"{side} turn", plan, hand)
            for side, hand in zip("LR", self._hands, strict=True)
        }
        for task in (left, right, squeeze):
            task.max_lead = 0.1
        levels: list[Any] = [
            [left, right, squeeze, *turns.values()], hurcules.PostureTask("posture", plan),
        ]  # fmt: skip
        options: dict[str, Any] = {"support": SUPPORT}
        if own is not None:
            levels.insert(0, own.setup.limits(plan))
            slow = hurcules.VelocityControllerOptions(max_acceleration=MAX_ACCELERATION)
            options = {"velocity": slow}
        controller = self.controller(
            plan,
            levels,
            {
                "left": hurcules.Twist(left, 0.3),
                "right": hurcules.Twist(right, 0.3),
                "across": hurcules.Twist(squeeze, 0.3),
                "squeeze": hurcules.ForceReference(squeeze, most),
                "left_turn": hurcules.Twist(turns["L"], 0.6),
                "right_turn": hurcules.Twist(turns["R"], 0.6),
            },
            dt=tick,
            safe=safe,
            **options,
        )
        simulation = self.loop(controller)
        controller.sense(squeeze, self._feels[1], row=2)
        return simulation

    def guards(self, plan: hurcules.Robot) -> list[Any]:
        """The table counts too: for the trunk, and of a robot of one's own for all of it."""
        if self._own is None:
            *levels, apart = super().guards(plan)
            pairs = [(part, "table") for part in TRUNK]
            table = hurcules.DistanceTask("table", plan, pairs, OFF, 2 * OFF, as_it_stands=True)
            return [*levels, [*apart, table]]
        return Safety(self._own.setup.name, self._model, plan, "").levels(plan)

    def configure(self, model: mujoco.MjModel, values: Mapping[str, Array]) -> None:
        """Half sizes, mass and friction of the box."""
        size, mass = values["size"], values["mass"][0]
        geom, body = model.geom("box"), model.body("box")
        resize_box(model, "box", size)
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
        squeeze = squeeze / self._share
        lever = 0.5 * (self._palm(numbers, 0) - self._palm(numbers, 1))
        left, right = v + np.cross(w, lever), v - np.cross(w, lever)
        closing = CLOSING * np.clip(squeeze[:, 0] / 100.0, -1.0, 1.0)
        forces = self._forces(numbers)
        left[:, 1] -= np.where((closing < 0.0) | (forces[:, 0] < FELT), closing, 0.0)
        across = right[:, 1:2] + closing[:, None]  # not where it feels the box: there force rules
        return {
            "left": left,
            "right": right[:, [0, 2]],
            "across": across,
            # a first-order force law moves by C (f_des - f): what the box's motion takes is added
            "squeeze": np.maximum(squeeze, 0.0) * self._share + right[:, 1:2] / self._compliance,
            "left_turn": w,
            "right_turn": w,
        }

    def start(self, generator: np.random.Generator) -> Start:
        """A box on the table, and where it is wanted."""
        size = generator.uniform(*HALF)
        x, y, top = self._place
        x, y = x + generator.uniform(-ASIDE, ASIDE), y + generator.uniform(-ASIDE, ASIDE)
        place = np.array([x, y, top + size[2]])
        qpos = np.array(self.simulation.data.qpos)
        qpos[self._box : self._box + 7] = [*place, 1.0, 0.0, 0.0, 0.0]
        mass = self._share * generator.uniform(*MASS)
        drawn = {"mass": mass, "friction": generator.uniform(0.8, 1.0)}
        goal = place + generator.uniform(*GOAL)
        yaw = generator.uniform(-YAW, YAW)
        memory = {"size": size, "stood": place[2], "goal": goal, "yaw": yaw}
        sizes = dict(zip(("half_x", "half_y", "half_z"), map(float, size), strict=True))
        return Start(qpos, memory | drawn, drawn | sizes)

    def remember(self, numbers: Numbers) -> None:
        """For how long the box has been at its goal."""
        numbers.hold(self._at_goal(numbers), HOLD)

    def observe(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        box, (left, right) = numbers["position/box"], self._hands
        return {
            "left": self._palm(numbers, 0) - box,
            "right": self._palm(numbers, 1) - box,
            "way": numbers["goal"] - box,
            "turn": self._turn(numbers),
            "velocity": 0.5 * (numbers[f"velocity/{left}"] + numbers[f"velocity/{right}"]),
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
        if self._own is not None:
            x, y, top = self._place
            return view((x, y, top + 0.15), 2.6, 215.0, -15.0)
        return view((0.65, 0.0, 1.0), 2.6, 215.0, -15.0)

    def draw(self, episodes: Any, i: int, scene: mujoco.MjvScene) -> None:
        """The goal as a green box one sees through."""
        memory = {name: values[i] for name, values in episodes.memory.items()}
        box_mark(scene, memory["goal"], memory["size"], _yawed(memory["yaw"])[0], GREEN)

    def _palm(self, numbers: Numbers, side: int) -> Array:
        """(n, 3) [m] middle of a palm in the world, of the left (0) or the right hand (1)."""
        hand = self._hands[side]
        ahead = numbers[f"matrix/{hand}"].reshape(-1, 3, 3)[:, :, 0]
        return numbers[f"position/{hand}"] - self._back * ahead

    def _forces(self, numbers: Numbers) -> Array:
        """(n, 2) [N] / share of the left and the right hand, across, towards the box."""
        left, right = (numbers[f"sensor/{feel}"][:, 2] for feel in self._feels)
        return np.stack([-left, right], axis=1) / self._share

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


def _wanted() -> Wanted:
    """What hands have to do to carry any of the boxes to any of its goals."""
    low, high = HALF[0, 2] + GOAL[0, 2], HALF[1, 2] + GOAL[1, 2]
    heights = (HALF[0, 2], 0.5 * (low + high), high)
    x, y = (GOAL[0, 0] - ASIDE, GOAL[1, 0] + ASIDE), GOAL[1, 1] + ASIDE
    sides = ((x[0], -y, -YAW), (x[1], -y, YAW), (x[1], y, -YAW), (x[0], y, YAW))
    corners = [(*side[:2], z, side[2]) for side in sides for z in heights]
    return Wanted(
        apart=(APART - HALF_HAND, HEIGHT - TABLE[1]),
        half=HALF[1, 1],
        corners=np.array([(0.0, 0.0, heights[0], 0.0), *corners]),
        squeeze=SQUEEZE,
        weight=9.81 * MASS[1],
        box=(HALF[1, 0], HALF[1, 1] - 0.005, HALF[1, 2]),
    )


WANTED = _wanted()
