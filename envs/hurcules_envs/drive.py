"""Hurcules/Drive-v0: the robot drives to a pose."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cached_property
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules.validation import require_known
from hurcules_envs.checks import require_flag, require_whole
from hurcules_envs.climbing import HOLDS, MIDDLE, climb, keep_on, ready_to_climb, shown
from hurcules_envs.commands import TWINS, by_joints
from hurcules_envs.drawing import add_arrow
from hurcules_envs.environment import Array, Environment, Group, Numbers, Start, tick_of, told
from hurcules_envs.robots import load_robot
from hurcules_envs.rotations import quaternion
from hurcules_envs.steering import along, steady, to_pose
from hurcules_envs.terrain import AHEAD, BESIDE, TERRAINS, Heights, scene_of

__all__ = ["Drive"]

CLIMBED = ("step_field", "stairs")  # tail first
SPEED, YAW_RATE, LEGS = 1.5, 1.0, 0.3  # [m/s], [rad/s], [rad/s] full scale
FAR = (2.0, 6.0)  # [m] of the goal
LANDING = (0.9, 2.9)  # [m] of one on top of the stairs, from their edge
WIDE, NARROW = 0.5, 0.1  # [m] beside the lane on terrain; on the pallets of a step field
NEAR, ALIGNED = 0.3, math.radians(15.0)  # [m], [rad] of success
STILL = 0.1  # [m/s]
EFFORT = 0.02
NEARBY = 1.0  # [m] over which the heading begins to count
CENTRE = -0.41  # [m] of the point that it turns about, from the knee axis; MIDDLE where it climbs
SEEN = ("x", "y", "cos", "sin")  # numbers of a goal
TILT, STEEP = 0.9, math.radians(60.0)  # [rad] of a robot that fell; that climbs
RADIUS = 0.14  # [m] of the tracks


class Drive(Environment):
    """The rescue robot drives on its tracks to a goal: place and heading.

    It starts folded as it drives, arms at rest. On flat ground the goal lies 2 to 6 m away
    anywhere, with any heading; on terrain ahead, up to 0.5 m beside its lane, with the heading of
    the start. Poses are in the world, of the point between the tracks that it turns about.

    On a step field and on stairs it starts as it climbs, and looks back: its lower legs are turned
    over to the front, its upper ones lead, trunk and arms lean forward. The goal lies on the
    landing of the stairs (five risers), 0.9 to 2.9 m behind its edge; or 2 to 6 m away and at most
    0.1 m beside the middle of the field, whose pallets are 1.2 m broad and its tracks 0.82 m.

    Action: Box(-1, 1, (3,), float32). Zero stands still.

    | index | name           | unit  | scale | what it commands                                 |
    |-------|----------------|-------|-------|--------------------------------------------------|
    | 0     | drive_speed    | m/s   | 1.5   | speed along the heading                          |
    | 1     | drive_yaw_rate | rad/s | 1.0   | yaw rate, > 0 to the left                        |
    | 2     | legs           | rad/s | 0.3   | both knees: > 0 lifts the body on its lower legs |

    On flat ground (`safe`), legs keep away from the arms, and it does not tip over: while its knees
    are beyond 0.02 rad it drives at 0.5 m/s and 0.5 rad/s at most and gains or loses 1 m/s^2, and
    they turn only below 0.6 m/s; within 0.1 rad they fold where it is to drive faster.

    Where it climbs, legs are straight at a knee of pi, and < 0 lifts the upper ones, which lead;
    the trunk turns with the knees, so that it stays leant over the lower legs.

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

    On terrain, unless `blind`, and on flat ground with `blind=False`, three groups follow:

    | group    | size | unit  | bound | what it is                                        |
    |----------|------|-------|-------|---------------------------------------------------|
    | ground   | 225  | m     | 1     | heights of the ground about the robot             |
    | held     | 3    | 1     | 1     | 1 where it is held for 1.5 s, for 3 s, for 4.5 s  |
    | aside    | 1    | m     | 1     | to the left of its line, where it tries then      |

    The heights lie about the point that the robot turns about, without noise, at 25 places from
    1.2 m behind it to 1.2 m ahead, at each of them 9 from 0.4 m left to 0.4 m right, all 0.1 m
    apart, over the soles at the knees. Where it climbs it drives towards "behind". Outside of the
    map (x from -4 to 9 m, y from -3 to 3 m) they are 0. It is held while its goal comes no nearer
    than it was; 0 where it does not climb, as is `aside`. A policy of flat ground fits terrain with
    `blind=True` alone, one of terrain flat ground with `blind=False`.

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
        blind: bool | None = None,
        safe: bool | None = None,
    ) -> None:
        """Builds robot, ground and loop.

        Args:
            fidelity: "exact", "fast", or on flat ground "kinematic".
            terrain: "flat", "ramps", "slope", "stairs", "rough_road", "step_field", "gravel",
                "sand".
            terrain_seed: draws the terrain: of the last four the ground, of ramps their angle (5 to
                15 degrees), of a slope too (10 to 30), of stairs pitch (25 to 35) and riser (0.15
                to 0.2 m); 0 is as the scene says (15 and 30 degrees; 35 degrees, 0.2 m).
            sparse: reward of success and fall only.
            rate: steps a second [Hz].
            action: "twist" (the table), or "joint": tracks, and the velocity of each coordinate.
            blind: the observation ends before `ground`; None: on flat ground alone.
            safe: legs (with "joint" all parts) keep apart from the rest, and with unfolded legs it
                drives slowly; None: on flat ground, where alone it can be.

        Raises:
            hurcules.Error: a value that does not exist or is out of range.
        """
        require_known("action", action, TWINS)
        blind = terrain == "flat" if blind is None else blind
        safe = terrain == "flat" if safe is None else safe
        require_flag("blind", blind)
        require_flag("safe", safe)
        require_known("terrain", terrain, TERRAINS)
        if fidelity == "kinematic" and terrain != "flat":
            raise hurcules.Error(f"fidelity: without physics the ground is flat, not {terrain}")
        require_whole("terrain_seed", terrain_seed, 0)
        if terrain == "flat" and terrain_seed != 0:
            raise hurcules.Error(f"terrain_seed: flat ground has none, got {terrain_seed!r}")
        if safe and terrain != "flat":
            raise hurcules.Error(f"safe: wanted flat ground, got {terrain}")
        self.terrain, self.terrain_seed, self.safe = terrain, terrain_seed, safe
        self._scene = scene_of(terrain, terrain_seed)
        self.sparse, self.rate = sparse, rate
        self._climbs = terrain in CLIMBED
        self._centre = MIDDLE if self._climbs else CENTRE
        self._sees = not blind
        tick, physics = tick_of(fidelity, rate), fidelity != "kinematic"
        model = self._model(visuals=False)
        robot = hurcules.Robot(model)
        robot.set_keyframe("drive")
        self._qpos = ready_to_climb(model, robot.qpos) if self._climbs else robot.qpos.copy()
        robot.set_qpos(self._qpos)
        self.goal = 4
        self.memory = {"goal": 4, "before": 4, "now": 4}  # the last two as they are seen
        self.memory |= dict.fromkeys(("way", "skew", "gained", "aligned", "speed", "done"), 1)
        if self._climbs:
            self.memory |= dict.fromkeys(HOLDS, 1)
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
        if self._sees:
            size = len(AHEAD) * len(BESIDE)
            self.observation += (
                Group("ground", size, "m", 1.0, "heights of the ground about the robot"),
                Group("held", 3, "1", 1.0, "1 where it is held for 1.5 s, for 3 s, for 4.5 s"),
                Group("aside", 1, "m", 1.0, "to the left of its line, where it tries then"),
            )
        self.units = {"drive": ("m/s", "rad/s"), "legs": "rad/s"}
        self.actions = {"drive": np.array([SPEED, YAW_RATE]), "legs": LEGS}
        self.components = {"legs": ("legs",)} if self._climbs else {}
        levels = self._levels(model, robot, action)
        controller = self._controller(robot, levels, action, tick, physics=physics)
        if physics:
            model = hurcules.models.with_timestep(model, tick)
        self.simulation = hurcules.Simulation(
            model=model,
            controller=controller,
            record=False,
            physics=physics,
            fall=hurcules.FallOptions("upper_legs", max_tilt=STEEP if self._climbs else TILT),
        )

    def _controller(
        self, plan: hurcules.Robot, levels: list[Any], action: str, tick: float, *, physics: bool
    ) -> hurcules.WholeBodyController:
        legs = hurcules.PostureTask("legs", plan, ["KN", "HIP"] if self._climbs else ["KN"])
        legs.max_lead = 0.2
        channels: dict[str, Any] = {
            "drive": hurcules.Drive(SPEED, YAW_RATE),
            "climb" if self._climbs else "legs": hurcules.Twist(legs, LEGS),
        }
        first = legs
        if action == "joint":
            drive = {"drive": self.actions["drive"]}
            first, channels = by_joints(self, plan, channels, drive)
        return hurcules.WholeBodyController(
            plan,
            [*levels, first, hurcules.PostureTask("posture", plan)],
            channels,
            dt=tick,
            base="sensed",
            drive=hurcules.DriveOptions(),
            torque_scaling=physics,
        )

    def _levels(self, model: mujoco.MjModel, plan: hurcules.Robot, action: str) -> list[Any]:
        """The limits, then distances: of the legs, or of all parts where joints are commanded."""
        if not self.safe:
            return []
        safety, twin = load_robot("rescue").safety, action == "joint"
        clear = {"upper_legs": 0.0}  # tracks lie on the ground
        if twin:
            clear |= dict.fromkeys(("L_uarm", "R_uarm"), safety.apart_by)
        of = () if twin else ("lower_leg_L", "lower_leg_R")
        apart = safety.distances_in_scene(model, plan, clear, of=of)
        return [hurcules.JointLimits("limits", plan), apart]

    def start(self, generator: np.random.Generator) -> Start:
        """On flat ground looking anywhere; on terrain where the scene has the robot."""
        qpos = self._qpos.copy()
        heading = np.pi if self._climbs else 0.0
        far = generator.uniform(*(LANDING if self.terrain == "stairs" else FAR))
        if self.terrain == "flat":
            heading = generator.uniform(-np.pi, np.pi)
            qpos[3:7] = quaternion(np.array([0.0, 0.0, heading]))
        x = float(qpos[0]) + self._centre * math.cos(heading)
        y = float(qpos[1]) + self._centre * math.sin(heading)
        if self.terrain == "flat":
            bearing, turn = generator.uniform(-np.pi, np.pi, 2)
            goal = (x + far * math.cos(bearing), y + far * math.sin(bearing), turn)
        else:
            wide = NARROW if self.terrain == "step_field" else WIDE
            begin = self._edge if self.terrain == "stairs" else x
            goal = (begin + far, y + generator.uniform(-wide, wide), heading)
        place = [*goal[:2], math.cos(goal[2]), math.sin(goal[2])]
        here = _seen(np.array([x, y, math.cos(heading), math.sin(heading)]))
        way, skew, _ = _errors(here, _seen(np.array(place)))
        memory = {"goal": place, "before": here, "now": here, "way": way, "skew": skew}
        if self._climbs:
            memory["nearest"] = way
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
        if self._climbs:
            keep_on(way, memory, numbers.dt)
        memory["speed"][:, 0] = np.linalg.norm(numbers["velocity/upper_legs"], axis=1)
        memory["done"][:, 0] = (way < NEAR) & aligned & (memory["speed"][:, 0] < STILL)

    def observe(self, numbers: Numbers) -> dict[str, Array]:
        """The goal and the motion, seen from the robot."""
        achieved, desired = self.goals(numbers)
        forward = achieved[:, 2:]
        velocity = numbers["velocity/upper_legs"]
        way = desired[:, :2] - achieved[:, :2]
        seen = {
            "goal": np.concatenate([_into(forward, way), _into(forward, desired[:, 2:])], axis=1),
            "velocity": np.concatenate([_into(forward, velocity[:, :2]), velocity[:, 2:]], axis=1),
            "spin": numbers["spin/upper_legs"],
            "up": numbers["matrix/upper_legs"][:, 6:],
            "legs": numbers["q/KN"],
            "margin": numbers["monitor/static_margin_m"],
        }
        return seen | self._about(numbers) if self._sees else seen

    def _about(self, numbers: Numbers) -> dict[str, Array]:
        """What is seen on terrain beside that."""
        return {"ground": self._ground(numbers)} | shown(numbers.memory, len(numbers.action))

    def _ground(self, numbers: Numbers) -> Array:
        """Heights [m] about the robot over the soles of its tracks at the knees."""

        def scan() -> Array:
            sole = numbers["position/upper_legs"][:, 2:] - RADIUS
            return self._heights.around(self.goals(numbers)[0], sole)

        return numbers.once("ground", scan)

    @cached_property
    def _edge(self) -> float:
        """Of the landing [m], along x."""
        return hurcules.scenes.scene(self.terrain, **self._scene).end

    @cached_property
    def _heights(self) -> Heights:
        return Heights(hurcules.scenes.make(self.terrain, seed=self.terrain_seed, **self._scene))

    def goals(self, numbers: Numbers) -> tuple[Array, Array]:
        """Pose of the robot, pose that is wanted."""
        R = numbers["matrix/upper_legs"]
        forward = np.stack([R[:, 4], -R[:, 1]], axis=1)  # across the track axle
        forward = forward / np.maximum(np.linalg.norm(forward, axis=1, keepdims=True), 1e-9)
        place = numbers["position/upper_legs"][:, :2] + self._centre * forward
        return np.concatenate([place, forward], axis=1), numbers["goal"]

    def reward(self, numbers: Numbers) -> dict[str, Array]:
        """Progress and heading, then what ends the episode."""
        shaped = 0.0 if self.sparse else 1.0
        effort = numbers.effort / numbers.action.shape[1]
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
        """Actions (n, 3) of a law of what is seen, on terrain also where it is blind."""
        seen = self.observe(numbers)
        blind = self._climbs and not self._sees
        return self.law(seen | self._about(numbers) if blind else seen)

    def law(self, seen: Mapping[str, Array]) -> Array:
        """Actions (n, 3): on flat ground `to_pose`, on terrain `along`, or `climb`.

        Args:
            seen: groups of the observation by name.
        """
        if self._climbs:
            speed, rate, legs = climb(seen)
        else:
            goal, flat = seen["goal"], self.terrain == "flat"
            speed, rate = to_pose(goal) if flat else along(goal[:, :2], goal, 0.8)
            legs = np.zeros_like(rate)
        action = np.stack([speed / SPEED, rate / YAW_RATE, legs / LEGS], axis=1)
        return np.clip(action, -1.0, 1.0)

    def camera(self) -> mujoco.MjvCamera:
        """From above, with all places where the goal may lie; of terrain from behind the start."""
        camera = mujoco.MjvCamera()
        if self.terrain == "flat":
            camera.distance, camera.azimuth, camera.elevation = 11.0, 140.0, -45.0
            return camera
        middle = (2.6, 0.0)
        camera.lookat[:] = (*middle, 0.2 + float(self._heights.at(np.array(middle))))
        camera.distance, camera.azimuth, camera.elevation = 7.5, 50.0, -25.0
        return camera

    def visual_model(self) -> mujoco.MjModel:
        """The same ground, and the robot with its surfaces."""
        return self._model(visuals=True)

    def draw(self, episodes: Any, i: int, scene: mujoco.MjvScene) -> None:
        """The goal, as an arrow."""
        x, y, cosine, sine = episodes.memory["goal"][i]
        ground = 0.0 if self.terrain == "flat" else self._heights.at(np.array([x, y]))
        z = 0.3 + float(np.nan_to_num(ground))
        add_arrow(scene, (x, y, z), (x + 0.8 * cosine, y + 0.8 * sine, z), 0.05, (0, 0.8, 0, 1))

    def _model(self, visuals: bool) -> mujoco.MjModel:
        return hurcules.models.load(
            "rescue",
            self.terrain,
            bed=False,
            visuals=visuals,
            seed=self.terrain_seed,
            **self._scene,
        )

    def command(self, action: Mapping[str, Array], numbers: Numbers) -> Mapping[str, Array]:
        """`steady`; where it climbs, the trunk turns with the knees: leant over the lower legs."""
        if self.safe:
            knee, forward = numbers["q/KN"], self.goals(numbers)[0][:, 2:]
            speed = _into(forward, numbers["velocity/upper_legs"][:, :2])[:, 0]
            legs = action.get("legs", np.zeros_like(knee))
            drive, legs = steady(action["drive"], legs, knee, speed, numbers.dt)
            return {**action, "drive": drive} | ({"legs": legs} if "legs" in action else {})
        if not self._climbs or "legs" not in action:
            return action
        return {"drive": action["drive"], "climb": np.repeat(action["legs"], 2, axis=1)}


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
