"""Hurcules/Press-v0: a hand presses on a surface and slides along a path."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, ClassVar

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules import models
from hurcules_envs.contact import ContactEnvironment, box_mark, euler_quat, view
from hurcules_envs.environment import Array, Group, Numbers, Start
from hurcules_envs.standing import SUPPORT

__all__ = ["Press"]

# [rad] kneeling, the right hand 0.22 m above the ground, the left one 0.05 m
POSTURE: Mapping[str, float] = MappingProxyType(
    {"KN": 1.9946, "HIP": 0.2711, "NKP": -0.7302, "LSP": 1.5, "RSP": 1.5}
    | {"LEB": 1.6, "REB": 1.15}
)
SETTLING = 1.5  # [s] until the robot stands and its arms hang still
HALF = (0.22, 0.20, 0.01)  # [m] of the plate
MASS = 5.0  # [kg] of the plate
PATH, CELLS = 0.20, 16  # [m] its length, and in how many parts it is counted
WIDTH = 0.02  # [m] beside the path that still counts
TOLERANCE = 0.10  # of the wanted force
MOST = 60.0  # [N] full scale of the force
SLIDING = 2.0  # [s] of friction alone: with the usual time a tip under 5 N hops
LAG, BIAS_LAG = 0.1, 0.5  # [s] of the load cell, of its difference from the hand's reading
PLACES = ((np.arange(CELLS) + 0.5) / CELLS - 0.5) * PATH  # [m] of the parts along the path
SPEED, MARGIN = 0.05, 0.01  # [m/s], [m] of the expert: along the path, and beyond its end
SPRING = 1100.0  # [N/m] of the elbow at the tip


class Press(ContactEnvironment):
    """The right hand of the rescue robot presses on a plate and slides along a path.

    The plate stands on springs, tilted; its load cell tells the force along its normal. The hand's
    own reading, which the force loop keeps, comes from the deflection of the elbow's spring:
    friction enters it, so that what is asked for is not what the plate bears. Path, plate and
    wanted force differ between episodes, the robot does not. An episode fails when the plate bears
    more than 100 N, and ends with success when each 12.5 mm of the path were passed within 20 mm
    while the plate bore the wanted force within 10 %.

    Actions, in [-1, 1]; zero holds hand and path, and asks for no force:

    | index | name | scale | unit | what |
    |---|---|---|---|---|
    | 0 | slide_0 | 0.1 | m/s | reference of the hand, forward |
    | 1 | slide_1 | 0.1 | m/s | to the left |
    | 2 | down | 0.1 | m/s | down, where nothing is touched |
    | 3 | force | 60 | N | that the hand presses down with, where it touches |

    Observation, in the world's axes (x forward, y left, z up):

    | index | name | bound | unit | what |
    |---|---|---|---|---|
    | 0-2 | hand | 1 | m | from the middle of the path to the hand |
    | 3-5 | velocity | 2 | m/s | of the hand |
    | 6-8 | lead | 0.5 | m | reference minus hand |
    | 9-11 | next | 1 | m | from the hand to the nearest part of the path not passed yet |
    | 12-14 | path | 1 |  | direction of the path |
    | 15-16 | ends | 0.5 | m | along the path to the first and the last part not passed yet |
    | 17 | wanted | 100 | N | force |
    | 18 | force | 200 | N | that the plate bears, low-pass of 0.1 s |
    | 19 | bias | 200 | N | hand's own reading less the plate's force, low-pass of 0.5 s |

    Reward:

    | term | what |
    |---|---|
    | distance | minus the distance to the next part of the path [m] |
    | force | minus 0.1 of the force's error over the wanted force, at most 0.1 |
    | passed | 10 times the share of the path passed in this step |
    | success | 10 once, when all of it is passed |
    """

    body = "rescue"
    # the hand that presses is commanded below the plate, as far as its spring gives
    clear: ClassVar[Mapping[str, float]] = MappingProxyType({"R_larm": 0.04})
    hanging = 0.02  # the path leads 24 mm from a track
    within = (0.20, 0.16)  # it kneels in the middle; nearer the edge it rocked, and fell
    task_description = "Press on the surface with the wanted force while sliding along the path."
    terms = ("distance", "force", "passed", "success")
    observation = (
        Group("hand", 3, "m", 1.0, "from the middle of the path to the hand"),
        Group("velocity", 3, "m/s", 2.0, "of the hand"),
        Group("lead", 3, "m", 0.5, "reference minus hand"),
        Group("next", 3, "m", 1.0, "from the hand to the nearest part of the path not passed yet"),
        Group("path", 3, "", 1.0, "direction of the path"),
        Group("ends", 2, "m", 0.5, "along the path to the first and the last part not passed yet"),
        Group("wanted", 1, "N", 100.0, "force"),
        Group("force", 1, "N", 200.0, "that the plate bears, low-pass of 0.1 s"),
        Group(
            "bias", 1, "N", 200.0, "hand's own reading less the plate's force, low-pass of 0.5 s"
        ),
    )
    memory: Mapping[str, int] = MappingProxyType(
        {"place": 3, "tilt": 2, "stiffness": 1, "friction": 1}
        | {"middle": 3, "path": 3, "wanted": 1, "passed": CELLS, "gain": 1, "over": 1}
        | {"force": 1, "bias": 1}
    )
    parameters = ("place", "tilt", "stiffness", "friction")
    quantities = (
        "position/R_tcp", "velocity/R_tcp", "target/slide", "target/down", "value/down",
        "value/slide", "force/down", "joint/surface",
    )  # fmt: skip

    def __init__(self, *, safe: bool = False, **options: Any) -> None:
        """See `ContactEnvironment`; the safe levels are off: they cost its policy successes."""
        super().__init__(safe=safe, **options)

    def _build(self, model: mujoco.MjModel, tick: float) -> None:
        self.units = {"slide": "m/s", "down": "m/s", "force": "N"}
        self.actions = {"slide": 0.1, "down": 0.1, "force": MOST}
        robot = hurcules.Robot(model)
        robot.set_keyframe("stretch")
        q = robot.configuration
        for name, angle in POSTURE.items():
            q[robot.coordinate(name)] = angle
        robot.stand_on(SUPPORT)
        robot.set_configuration(q)
        settled = self._loop(robot, tick, safe=False)
        settled.step(round(SETTLING / tick))
        start = hurcules.Robot(model)
        start.set_qpos(settled.data.qpos)
        self.simulation = self._loop(start, tick, safe=self.safe)
        self._hand = np.array(start.position("R_tcp"))

    def scene(self) -> mujoco.MjSpec:
        """The robot kneels behind a plate on springs."""
        spec = models.parse([models.path("rescue"), models.path("flat")], "press")
        body = spec.worldbody.add_body(name="surface", pos=[1.45, -0.33, 0.1], gravcomp=1.0)
        body.add_joint(name="surface", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 0, 1])
        body.add_geom(
            name="surface", type=mujoco.mjtGeom.mjGEOM_BOX, size=HALF, pos=[0, 0, -HALF[2]],
            mass=MASS, contype=0, conaffinity=4, rgba=[0.45, 0.50, 0.55, 1.0],
        )  # fmt: skip
        post = [0.0, 0.0, -2 * HALF[2], 0.0, 0.0, -0.4]
        body.add_geom(  # only seen
            type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=[0.03, 0.0, 0.0], fromto=post, mass=0.0,
            contype=0, conaffinity=0, rgba=[0.30, 0.33, 0.36, 1.0],
        )  # fmt: skip
        for part in ("blade", "tip"):
            spec.add_pair(
                name=f"{part}_on_surface", geomname1=f"R_scoop_{part}", geomname2="surface",
                condim=3, friction=[0.3, 0.3, 0.005, 1e-4, 1e-4], solreffriction=[SLIDING, 1.0],
            )  # fmt: skip
        return spec

    def _loop(self, plan: hurcules.Robot, tick: float, *, safe: bool) -> Any:
        plan.stand_on(SUPPORT)
        across = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
        slide = hurcules.PositionTask("slide", plan, "R_tcp", axes=across)
        slide.max_lead = 0.05
        down = hurcules.ForceTask(
            "down", plan, "R_tcp", axis=[0.0, 0.0, -1.0], force_des=0.0, environment=SPRING,
            gains=hurcules.ForceGains(compliance=0.05, dt=tick),
            contact=hurcules.ContactOptions(f_max=150.0),
        )  # fmt: skip
        down.max_lead = 0.05
        pitch = hurcules.AngleTask("pitch", plan, "R_tcp")
        levels = [[slide, down], pitch, hurcules.PostureTask("posture", plan)]
        controller = self.controller(
            plan,
            levels,
            {
                "slide": hurcules.Twist(slide, 0.1),
                "down": hurcules.Twist(down, 0.1),
                "force": hurcules.ForceReference(down, MOST),
            },
            dt=tick,
            safe=safe,
            support=SUPPORT,
        )
        simulation = self.loop(controller)
        controller.sense(down, hurcules.SpringForce(plan, "REBS", "R_tcp"))
        return simulation

    def configure(self, model: mujoco.MjModel, values: Mapping[str, Array]) -> None:
        """Place, tilt, stiffness (damped by 0.7) and friction of the plate."""
        surface = model.body("surface").id
        model.body_pos[surface] = values["place"]
        model.body_quat[surface] = euler_quat(values["tilt"][0], values["tilt"][1], 0.0)
        joint = model.joint("surface")
        joint.stiffness[0] = values["stiffness"][0]
        joint.damping[0] = 1.4 * math.sqrt(MASS * values["stiffness"][0])
        for part in ("blade", "tip"):
            model.pair(f"{part}_on_surface").friction[:2] = values["friction"][0]

    def start(self, generator: np.random.Generator) -> Start:
        """A plate below the hand, and a path on it."""
        tilt = generator.uniform(-0.12, 0.12, 2)
        aside, below = generator.uniform(-0.04, 0.04, 2), generator.uniform(-0.07, -0.04)
        place = self._hand + np.array([*aside, below])
        normal = _normal(tilt)
        angle = generator.uniform(-math.pi, math.pi)
        flat = np.array([math.cos(angle), math.sin(angle), 0.0])
        path = flat - flat @ normal / normal[2] * np.array([0.0, 0.0, 1.0])
        path /= np.linalg.norm(path)
        drawn = {
            "stiffness": math.exp(generator.uniform(math.log(1e3), math.log(1e4))),
            "friction": generator.uniform(0.1, 0.5),
            "wanted": generator.uniform(8.0, 25.0),
        }
        tilts = {"tilt_x": float(tilt[0]), "tilt_y": float(tilt[1])}
        memory = {"place": place, "tilt": tilt, "middle": place, "path": path}
        return Start(None, memory | drawn, drawn | tilts)

    def load(self, numbers: Numbers) -> Array:
        """(n, 1) [N] what the plate's springs bear; its weight is borne apart."""
        return -numbers["stiffness"] * numbers["joint/surface"]

    def remember(self, numbers: Numbers) -> None:
        """Which parts of the path are passed, and whether the plate bore too much."""
        load = self.load(numbers)
        force, bias = numbers.memory["force"], numbers.memory["bias"]
        force += (1.0 - math.exp(-numbers.dt / LAG)) * (load - force)
        share = np.where(load > 1.0, 1.0 - math.exp(-numbers.dt / BIAS_LAG), 0.0)
        bias += share * (numbers["force/down"] - load - bias)
        wanted = numbers["wanted"]
        away, along = self._place(numbers)
        beside = away - along[:, None] * numbers["path"]
        right = np.abs(force - wanted)[:, 0] <= TOLERANCE * wanted[:, 0]
        right &= np.linalg.norm(beside[:, :2], axis=1) < WIDTH
        cell = np.floor((along / PATH + 0.5) * CELLS).astype(int)
        right &= (cell >= 0) & (cell < CELLS)
        passed = numbers.memory["passed"]
        before = passed.sum(axis=1)
        rows = np.flatnonzero(right)
        passed[rows, cell[rows]] = 1.0
        numbers.memory["gain"][:, 0] = passed.sum(axis=1) - before
        numbers.memory["over"][load > 100.0] = 1.0

    def observe(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        lead_xy = numbers["target/slide"] - numbers["value/slide"]
        lead_z = numbers["value/down"] - numbers["target/down"]
        return {
            "hand": numbers["position/R_tcp"] - numbers["middle"],
            "velocity": numbers["velocity/R_tcp"],
            "lead": np.concatenate([lead_xy, lead_z], axis=1),
            "next": self._next(numbers),
            "path": numbers["path"],
            "ends": self._ends(numbers),
            "wanted": numbers["wanted"],
            "force": numbers["force"],
            "bias": numbers["bias"],
        }

    def reward(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        shaped = 0.0 if self.sparse else 1.0
        error = np.abs(numbers["force"] - numbers["wanted"]) / numbers["wanted"]
        gain = numbers["gain"][:, 0]
        return {
            "distance": -shaped * np.linalg.norm(self._next(numbers), axis=1),
            "force": -0.1 * shaped * np.minimum(error[:, 0], 1.0),
            "passed": 10.0 * gain / CELLS,
            "success": 10.0 * (self.succeeded(numbers) & (gain > 0.0)).astype(np.float64),
        }

    def succeeded(self, numbers: Numbers) -> NDArray[np.bool_]:
        """All of the path was passed."""
        return numbers["passed"].min(axis=1) > 0.0

    def failed(self, numbers: Numbers) -> NDArray[np.bool_]:
        """The plate bore more than 100 N."""
        return numbers["over"][:, 0] > 0.0

    def expert(self, numbers: Numbers) -> Array:
        """Down on the path, then to and fro along what is left of it.

        What friction adds to the hand's reading is allowed for.
        """
        seen = self.observe(numbers)
        path, ahead, ends = seen["path"], seen["next"], seen["ends"]
        touches = seen["force"][:, 0] > 1.0
        beside = ahead - np.einsum("ni,ni->n", ahead, path)[:, None] * path
        moves = np.einsum("ni,ni->n", seen["velocity"], path)
        nearer = np.abs(ends[:, 1]) < np.abs(ends[:, 0])
        up = np.where(np.abs(moves) > 0.01, moves > 0.0, nearer)
        up = np.where(up, ends[:, 1] > -MARGIN, ends[:, 0] > MARGIN)
        pace = np.where(touches, np.where(up, SPEED, -SPEED), 0.0)
        wish = 4.0 * np.where(touches[:, None], beside, ahead) + pace[:, None] * path
        near = np.linalg.norm(ahead[:, :2], axis=1, keepdims=True) < 0.02
        down = np.where(near & ~touches[:, None], 0.5, 0.0)
        force = seen["wanted"] + np.clip(seen["bias"], -10.0, 10.0)
        action = np.concatenate([wish[:, :2] / 0.1, down, force / MOST], axis=1)
        return np.clip(action, -1.0, 1.0)

    def camera(self) -> mujoco.MjvCamera:
        """From the right, near the plate."""
        return view((1.48, -0.33, 0.22), 1.05, 60.0, -28.0)

    def draw(self, episodes: Any, i: int, scene: mujoco.MjvScene) -> None:
        """The path: orange what is left, green what is passed."""
        memory = {name: values[i] for name, values in episodes.memory.items()}
        normal, path = _normal(memory["tilt"]), memory["path"]
        turned = np.stack([path, np.cross(normal, path), normal], axis=1)
        half = np.array([0.45 * PATH / CELLS, 0.008, 0.001])
        for cell, passed in enumerate(memory["passed"]):
            place = memory["middle"] + ((cell + 0.5) / CELLS - 0.5) * PATH * path + 0.001 * normal
            color = (0.1, 0.75, 0.2, 1.0) if passed else (1.0, 0.45, 0.0, 1.0)
            box_mark(scene, place, half, turned, color)

    def _place(self, numbers: Numbers) -> tuple[Array, Array]:
        """From the middle of the path to the hand (n, 3), and how far along it that is (n,)."""
        away = numbers["position/R_tcp"] - numbers["middle"]
        return away, np.einsum("ni,ni->n", away, numbers["path"])

    def _next(self, numbers: Numbers) -> Array:
        """(n, 3) [m] from the hand to the middle of the nearest part not passed; 0 at the end."""
        away, along = self._place(numbers)
        gap = np.abs(along[:, None] - PLACES) + 10.0 * numbers["passed"]
        ahead = PLACES[gap.argmin(axis=1)][:, None] * numbers["path"] - away
        return np.where(self.succeeded(numbers)[:, None], 0.0, ahead)

    def _ends(self, numbers: Numbers) -> Array:
        """(n, 2) [m] along the path from the hand to the first and last part not passed."""
        _, along = self._place(numbers)
        left = numbers["passed"] == 0.0
        first = np.where(left, PLACES, np.inf).min(axis=1)
        last = np.where(left, PLACES, -np.inf).max(axis=1)
        ends = np.stack([first, last], axis=1) - along[:, None]
        return np.where(self.succeeded(numbers)[:, None], 0.0, ends)


def _normal(tilt: Array) -> Array:
    rotation = np.zeros(9)
    mujoco.mju_quat2Mat(rotation, euler_quat(tilt[0], tilt[1], 0.0))
    return rotation.reshape(3, 3)[:, 2]
