"""Hurcules/Drive-v0: the robot drives to a pose."""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules.validation import require_known
from hurcules_envs.commands import TWINS, by_joints
from hurcules_envs.drawing import add_arrow
from hurcules_envs.environment import Array, Environment, Group, Numbers, Start, tick_of, told
from hurcules_envs.rotations import quaternion

__all__ = ["Drive"]

DRAWN = ("rough_road", "step_field", "gravel", "sand")  # by a seed
TERRAINS = ("flat", "ramps", "slope", *DRAWN)
SPEED, YAW_RATE, LEGS = 1.5, 1.0, 0.3  # [m/s], [rad/s], [rad/s] full scale
FAR = (2.0, 6.0)  # [m] of the goal
WIDE = 0.5  # [m] beside the lane on terrain
NEAR, ALIGNED = 0.3, math.radians(15.0)  # [m], [rad] of success
STILL = 0.1  # [m/s]
EFFORT = 0.02
NEARBY = 1.0  # [m] over which the heading begins to count
CENTRE = -0.41  # [m] of the point that it turns about, its centre of mass, from the knee axis
SEEN = ("x", "y", "cos", "sin")  # numbers of a goal
TILT = 0.9  # [rad] of a robot that fell


class Drive(Environment):
    """The rescue robot drives on its tracks to a goal: place and heading.

    It starts folded as it drives, arms at rest. On flat ground the goal lies 2 to 6 m away
    anywhere, with any heading; on terrain ahead, with the heading of the start. Poses are in the
    world, of the point between the tracks that it turns about.

    Action: Box(-1, 1, (3,), float32). Zero stands still.

    | index | name           | unit  | scale | what it commands                                 |
    |-------|----------------|-------|-------|--------------------------------------------------|
    | 0     | drive_speed    | m/s   | 1.5   | speed along the heading                          |
    | 1     | drive_yaw_rate | rad/s | 1.0   | yaw rate, > 0 to the left                        |
    | 2     | legs           | rad/s | 0.3   | both knees: > 0 lifts the body on its lower legs |

    With the action "joint" the velocity of each coordinate's reference comes first, in place of the
    legs alone, and the observation ends with the coordinates.

    Observation: Dict of `observation` (15,), `achieved_goal` and `desired_goal` (4,): x, y [m],
    cosine and sine of the heading.

    | group    | size | unit  | bound | what it is                                        |
    |----------|------|-------|-------|---------------------------------------------------|
    | goal     | 4    | m, 1  | 20    | goal seen from the robot: x, y, cosine, sine      |
    | velocity | 3    | m/s   | 10    | of the robot along its heading, to its left, up   |
    | spin     | 3    | rad/s | 10    | of the robot, in the world                        |
    | up       | 3    | 1     | 1     | the vertical, seen from the robot                 |
    | legs     | 1    | rad   | 4     | knee                                              |
    | margin   | 1    | m     | 2     | of the centre of mass within what it stands on    |

    Reward: `progress`, the way [m] that the goal came nearer; `heading`, what half of the heading's
    error [rad] times exp(-d / 1 m) became smaller, d the distance of the goal; `success`, 10 once;
    `fall`, -10 once; `effort`, minus 0.02 times the mean square of the action. The first two are
    differences of a potential (Ng, Harada and Russell, ICML 1999), so that no detour pays. Success:
    nearer than 0.3 m and 15 degrees, at less than 0.1 m/s. Both success and a fall end the episode.

    What `compute_reward` wants to know beside the goals stands in `info`: `before_x`, `before_y`,
    `before_cos` and `before_sin`, the achieved goal of the step before, and `speed` [m/s].
    """

    task_description = "Drive to the goal and stand there with the wanted heading."
    terms = ("progress", "heading", "success", "fall", "effort")

    def __init__(
        self,
        fidelity: str = "exact",
        terrain: str = "flat",
        terrain_seed: int = 0,
        sparse: bool = False,
        rate: float = 10.0,
        action: str = "twist",
    ) -> None:
        """Builds robot, ground and loop.

        Args:
            fidelity: "exact", "fast", or on flat ground "kinematic".
            terrain: "flat", "ramps", "slope", "rough_road", "step_field", "gravel", "sand".
            terrain_seed: of one of the last four, which are drawn; the others are as they are.
            sparse: reward of success and fall only.
            rate: steps a second [Hz].
            action: "twist" (the table), or "joint": tracks, and the velocity of each coordinate.

        Raises:
            hurcules.Error: a value that does not exist or is out of range.
        """
        require_known("action", action, TWINS)
        require_known("terrain", terrain, TERRAINS)
        if fidelity == "kinematic" and terrain != "flat":
            raise hurcules.Error(f"fidelity: without physics the ground is flat, not {terrain}")
        if terrain not in DRAWN and terrain_seed != 0:
            raise hurcules.Error(
                f"terrain_seed: '{terrain}' is always the same; wanted none, got {terrain_seed!r}, "
                f"or one of the terrains that are drawn: {', '.join(DRAWN)}"
            )
        self.terrain, self.terrain_seed = terrain, terrain_seed
        self.sparse, self.rate = sparse, rate
        tick, physics = tick_of(fidelity, rate), fidelity != "kinematic"
        model = self._model(visuals=False)
        robot = hurcules.Robot(model)
        robot.set_keyframe("drive")
        self._qpos = robot.qpos.copy()
        self.goal = 4
        self.memory = {"goal": 4, "before": 4, "now": 4}  # the last two as they are seen
        self.memory |= dict.fromkeys(("way", "skew", "gained", "aligned", "speed", "done"), 1)
        self.quantities = (
            "position/upper_legs",
            "matrix/upper_legs",
            "velocity/upper_legs",
            "spin/upper_legs",
            "q/KN",
            "monitor/static_margin_m",
        )
        self.observation = (
            Group("goal", 4, "m, 1", 20.0, "goal seen from the robot: x, y, cosine, sine"),
            Group("velocity", 3, "m/s", 10.0, "of the robot along its heading, to its left, up"),
            Group("spin", 3, "rad/s", 10.0, "of the robot, in the world"),
            Group("up", 3, "1", 1.0, "the vertical, seen from the robot"),
            Group("legs", 1, "rad", 4.0, "knee"),
            Group("margin", 1, "m", 2.0, "of the centre of mass within what it stands on"),
        )
        self.units = {"drive": ("m/s", "rad/s"), "legs": "rad/s"}
        self.actions = {"drive": np.array([SPEED, YAW_RATE]), "legs": LEGS}
        controller = self._controller(robot, model, action, tick, physics=physics)
        if physics:
            model = hurcules.models.with_timestep(model, tick)
        self.simulation = hurcules.Simulation(
            model=model,
            controller=controller,
            record=False,
            physics=physics,
            fall=hurcules.FallOptions("upper_legs", max_tilt=TILT),
        )

    def _controller(
        self,
        plan: hurcules.Robot,
        model: mujoco.MjModel,
        action: str,
        tick: float,
        *,
        physics: bool,
    ) -> hurcules.WholeBodyController:
        legs = hurcules.PostureTask("legs", plan, ["KN"])
        legs.max_lead = 0.2
        channels: dict[str, Any] = {
            "drive": hurcules.Drive(SPEED, YAW_RATE),
            "legs": hurcules.Twist(legs, LEGS),
        }
        first = legs
        if action == "joint":
            drive = {"drive": self.actions["drive"]}
            first, channels = by_joints(self, plan, model, channels, drive)
        return hurcules.WholeBodyController(
            plan,
            [first, hurcules.PostureTask("posture", plan)],
            channels,
            dt=tick,
            base="sensed",
            drive=hurcules.DriveOptions(),
            torque_scaling=physics,
        )

    def start(self, generator: np.random.Generator) -> Start:
        """On flat ground anywhere, looking anywhere; on terrain where the scene has the robot."""
        qpos = self._qpos.copy()
        far, heading = generator.uniform(*FAR), 0.0
        if self.terrain == "flat":
            heading = generator.uniform(-np.pi, np.pi)
            qpos[3:7] = quaternion(np.array([0.0, 0.0, heading]))
        x = float(qpos[0]) + CENTRE * math.cos(heading)
        y = float(qpos[1]) + CENTRE * math.sin(heading)
        if self.terrain == "flat":
            bearing, turn = generator.uniform(-np.pi, np.pi, 2)
            goal = (x + far * math.cos(bearing), y + far * math.sin(bearing), turn)
        else:
            goal = (x + far, y + generator.uniform(-WIDE, WIDE), 0.0)
        place = [*goal[:2], math.cos(goal[2]), math.sin(goal[2])]
        here = _seen(np.array([x, y, math.cos(heading), math.sin(heading)]))
        way, skew, _ = _errors(here, _seen(np.array(place)))
        memory = {"goal": place, "before": here, "now": here, "way": way, "skew": skew}
        return Start(qpos, memory)

    def remember(self, numbers: Numbers) -> None:
        """Where it was and is, what that gained, and whether it is done."""
        achieved, desired = self.goals(numbers)
        memory = numbers.memory
        memory["before"][:] = memory["now"]
        memory["now"][:] = _seen(achieved)
        way, skew, aligned = _errors(memory["now"], _seen(desired))
        memory["gained"][:, 0] = memory["way"][:, 0] - way
        memory["aligned"][:, 0] = memory["skew"][:, 0] - skew
        memory["way"][:, 0], memory["skew"][:, 0] = way, skew
        memory["speed"][:, 0] = np.linalg.norm(numbers["velocity/upper_legs"], axis=1)
        memory["done"][:, 0] = (way < NEAR) & aligned & (memory["speed"][:, 0] < STILL)

    def observe(self, numbers: Numbers) -> dict[str, Array]:
        """The goal and the motion, seen from the robot."""
        achieved, desired = self.goals(numbers)
        forward = achieved[:, 2:]
        velocity = numbers["velocity/upper_legs"]
        way = desired[:, :2] - achieved[:, :2]
        return {
            "goal": np.concatenate([_into(forward, way), _into(forward, desired[:, 2:])], axis=1),
            "velocity": np.concatenate([_into(forward, velocity[:, :2]), velocity[:, 2:]], axis=1),
            "spin": numbers["spin/upper_legs"],
            "up": numbers["matrix/upper_legs"][:, 6:],
            "legs": numbers["q/KN"],
            "margin": numbers["monitor/static_margin_m"],
        }

    def goals(self, numbers: Numbers) -> tuple[Array, Array]:
        """Pose of the robot, pose that is wanted."""
        R = numbers["matrix/upper_legs"]
        forward = np.stack([R[:, 4], -R[:, 1]], axis=1)  # across the track axle
        forward = forward / np.maximum(np.linalg.norm(forward, axis=1, keepdims=True), 1e-9)
        place = numbers["position/upper_legs"][:, :2] + CENTRE * forward
        return np.concatenate([place, forward], axis=1), numbers["goal"]

    def reward(self, numbers: Numbers) -> dict[str, Array]:
        """Progress and heading, then what ends the episode."""
        shaped = 0.0 if self.sparse else 1.0
        effort = np.einsum("ni,ni->n", numbers.action, numbers.action) / numbers.action.shape[1]
        return {
            "progress": shaped * numbers["gained"][:, 0],
            "heading": shaped * numbers["aligned"][:, 0],
            "success": 10.0 * numbers["done"][:, 0],
            "fall": -10.0 * numbers.finished.astype(np.float64),
            "effort": -shaped * EFFORT * effort,
        }

    def compute_reward(self, achieved: Array, desired: Array, info: Any) -> Array | float:
        """The reward of other goals, any leading axes.

        Args:
            achieved: (..., 4).
            desired: (..., 4).
            info: of a step, of several in a vector, or a sequence of those of single ones. Where it
                is empty the robot counts as standing where it stood before.
        """
        one, other = np.asarray(achieved, float), np.asarray(desired, float)
        before = np.stack([told(info, f"before_{name}", np.nan) for name in SEEN], axis=-1)
        way_before, skew_before, _ = _errors(np.where(np.isnan(before), one, before), other)
        way, skew, aligned = _errors(one, other)
        shaped = 0.0 if self.sparse else 1.0
        reward = shaped * (way_before - way) + shaped * (skew_before - skew)
        reward = reward + 10.0 * ((way < NEAR) & aligned & (told(info, "speed") < STILL))
        reward = reward + told(info, "reward_fall") + told(info, "reward_effort")
        return float(reward) if np.ndim(reward) == 0 else reward

    def tell(self, numbers: Numbers) -> dict[str, Array]:
        """What `compute_reward` wants to know."""
        before = {f"before_{name}": numbers["before"][:, i] for i, name in enumerate(SEEN)}
        return before | {"speed": numbers["speed"][:, 0]}

    def succeeded(self, numbers: Numbers) -> NDArray[np.bool_]:
        """It stands at the goal with the wanted heading."""
        return numbers["done"][:, 0] > 0.0

    def ended(self, numbers: Numbers) -> NDArray[np.bool_]:
        """Success ends the episode."""
        return self.succeeded(numbers)

    def expert(self, numbers: Numbers) -> Array:
        """Actions (n, 3) of a smooth law for unicycles (Park and Kuipers, ICRA 2011)."""
        seen = self.observe(numbers)["goal"]
        way = np.linalg.norm(seen[:, :2], axis=1)
        sight = np.arctan2(seen[:, 1], seen[:, 0])  # of the goal, from the heading
        turn = np.arctan2(seen[:, 3], seen[:, 2])
        delta, theta = _wrap(-sight), _wrap(turn - sight)
        k1, k2 = 1.0, 3.0
        bend = k2 * (delta - np.arctan(-k1 * theta)) + (1 + k1 / (1 + (k1 * theta) ** 2)) * np.sin(
            delta
        )
        bend = -bend / np.maximum(way, 0.05)
        speed = np.minimum(1.2 / (1.0 + 0.4 * np.abs(bend) ** 1.5), 0.8 * way)
        near = way < 0.15
        speed = np.where(near, 0.0, np.maximum(speed, 0.08))
        rate = np.where(near, 1.5 * turn, speed * bend)
        action = np.stack([speed / SPEED, rate / YAW_RATE, np.zeros_like(way)], axis=1)
        return np.clip(action, -1.0, 1.0)

    def camera(self) -> mujoco.MjvCamera:
        """From above, with all places where the goal may lie."""
        camera = mujoco.MjvCamera()
        camera.lookat[:] = (0.0 if self.terrain == "flat" else 3.0, 0.0, 0.0)
        camera.distance, camera.azimuth, camera.elevation = 11.0, 140.0, -45.0
        return camera

    def visual_model(self) -> mujoco.MjModel:
        """The same ground, and the robot with its surfaces."""
        return self._model(visuals=True)

    def draw(self, episodes: Any, i: int, scene: mujoco.MjvScene) -> None:
        """The goal, as an arrow."""
        x, y, cosine, sine = episodes.memory["goal"][i]
        add_arrow(scene, (x, y, 0.3), (x + 0.8 * cosine, y + 0.8 * sine, 0.3), 0.05, (0, 0.8, 0, 1))

    def _model(self, visuals: bool) -> mujoco.MjModel:
        seed = self.terrain_seed
        return hurcules.models.load("rescue", self.terrain, bed=False, visuals=visuals, seed=seed)


def _into(forward: Array, vector: Array) -> Array:
    """Planar vectors (n, 2) along a heading (n, 2) and to its left."""
    along = np.einsum("ni,ni->n", forward, vector)
    left = forward[:, 0] * vector[:, 1] - forward[:, 1] * vector[:, 0]
    return np.stack([along, left], axis=1)


def _seen(goal: Array) -> Array:
    """As it is in the observation, so that `compute_reward` gives the same bits."""
    return goal.astype(np.float32).astype(float)


def _errors(now: Array, goal: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Distance [m] of poses, what their angle [rad] counts there, whether it is small; (...)."""
    between = now[..., :2] - goal[..., :2]
    way = np.sqrt(np.einsum("...i,...i->...", between, between))
    cosine = np.einsum("...i,...i->...", now[..., 2:], goal[..., 2:])
    turn = np.arccos(np.maximum(np.minimum(cosine, 1.0), -1.0))
    return way, 0.5 * turn * np.exp(-way / NEARBY), turn < ALIGNED


def _wrap(angle: Array) -> Array:
    return (angle + np.pi) % (2.0 * np.pi) - np.pi
