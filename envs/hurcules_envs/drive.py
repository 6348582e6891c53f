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
from hurcules_envs.checks import require_flag
from hurcules_envs.commands import TWINS, by_joints
from hurcules_envs.drawing import add_arrow
from hurcules_envs.environment import Array, Environment, Group, Numbers, Start, tick_of, told
from hurcules_envs.rotations import quaternion
from hurcules_envs.terrain import AHEAD, BESIDE, Heights

__all__ = ["Drive"]

DRAWN = ("rough_road", "step_field", "gravel", "sand")  # by a seed
TERRAINS = ("flat", "ramps", "slope", "stairs", *DRAWN)
CLIMBED = ("step_field", "stairs")  # tail first
SCENES: dict[str, dict[str, Any]] = {"stairs": {"landing": 4.0}}  # by terrain, of its scene
# [rad] of the joints where it climbs: lower legs turned over to the front, trunk and arms forward
CLIMBING = {
    "LKN": math.pi, "RKN": math.pi, "HIP": 1.0, "LSP": 1.9, "RSP": 1.9, "LEB": 0.6, "REB": 0.6,
}  # fmt: skip
SPEED, YAW_RATE, LEGS = 1.5, 1.0, 0.3  # [m/s], [rad/s], [rad/s] full scale
FAR = (2.0, 6.0)  # [m] of the goal
LANDING = (4.0, 6.0)  # [m] of one on top of the stairs
WIDE, NARROW = 0.5, 0.1  # [m] beside the lane on terrain; on the pallets of a step field
NEAR, ALIGNED = 0.3, math.radians(15.0)  # [m], [rad] of success
STILL = 0.1  # [m/s]
EFFORT = 0.02
NEARBY = 1.0  # [m] over which the heading begins to count
# [m] of the point that it turns about, its centre of mass, from the knee axis; where it climbs
CENTRE, MIDDLE = -0.41, 0.07
SEEN = ("x", "y", "cos", "sin")  # numbers of a goal
TILT, STEEP = 0.9, math.radians(60.0)  # [rad] of a robot that fell; that climbs
RADIUS = 0.14  # [m] of the tracks
# how it climbs, all but the first two fitted on step fields of the seeds 0 to 3
TAIL, BATTERY = 0.6, 0.04  # [m] from the knees to the end of the upper legs; over their soles
CLEAR, ASIDE, HELD = 0.03, 0.16, 1.5  # [m] over what is ahead; beside what holds it; [s] until then
STRAIGHT, RAISED, HIGHER = -0.09, 0.75, 0.35  # [rad] of the knees: least, most, more where held
HOLDS = ("nearest", "held", "edge", "tries", "aside")  # what it remembers of that


class Drive(Environment):
    """The rescue robot drives on its tracks to a goal: place and heading.

    It starts folded as it drives, arms at rest. On flat ground the goal lies 2 to 6 m away
    anywhere, with any heading; on terrain ahead, up to 0.5 m beside its lane, with the heading of
    the start. Poses are in the world, of the point between the tracks that it turns about.

    On a step field and on stairs it starts as it climbs, and looks back: its lower legs are turned
    over to the front, its upper ones lead, trunk and arms lean forward. The goal lies 4 to 6 m away
    on the landing of the stairs (35 degrees, 1 m high), or 2 to 6 m away and at most 0.1 m beside
    the middle of the field, whose pallets are 1.2 m broad and its tracks 0.82 m.

    Action: Box(-1, 1, (3,), float32). Zero stands still.

    | index | name           | unit  | scale | what it commands                                 |
    |-------|----------------|-------|-------|--------------------------------------------------|
    | 0     | drive_speed    | m/s   | 1.5   | speed along the heading                          |
    | 1     | drive_yaw_rate | rad/s | 1.0   | yaw rate, > 0 to the left                        |
    | 2     | legs           | rad/s | 0.3   | both knees: > 0 lifts the body on its lower legs |

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

    On terrain, unless `blind`, the group `ground` follows (225 numbers, m, bound 1): heights of the
    ground about the point that the robot turns about, without noise, at 25 places from 1.2 m behind
    it to 1.2 m ahead, at each of them 9 from 0.4 m left to 0.4 m right, all 0.1 m apart, over the
    soles at the knees. Where it climbs it drives towards "behind". Outside of the map (x from -4 to
    9 m, y from -3 to 3 m) they are 0. A policy of flat ground fits terrain with `blind=True` alone.

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
        blind: bool = False,
    ) -> None:
        """Builds robot, ground and loop.

        Args:
            fidelity: "exact", "fast", or on flat ground "kinematic".
            terrain: "flat", "ramps", "slope", "stairs", "rough_road", "step_field", "gravel",
                "sand".
            terrain_seed: of one of the last four, which are drawn; the others are as they are.
            sparse: reward of success and fall only.
            rate: steps a second [Hz].
            action: "twist" (the table), or "joint": tracks, and the velocity of each coordinate.
            blind: the observation is that of flat ground, without `ground`.

        Raises:
            hurcules.Error: a value that does not exist or is out of range.
        """
        require_known("action", action, TWINS)
        require_flag("blind", blind)
        require_known("terrain", terrain, TERRAINS)
        if fidelity == "kinematic" and terrain != "flat":
            raise hurcules.Error(f"fidelity: without physics the ground is flat, not {terrain}")
        if terrain not in DRAWN and terrain_seed != 0:
            raise hurcules.Error(
                f"terrain_seed: '{terrain}' is always the same; wanted none, got {terrain_seed!r}, "
                f"or one of the terrains that are drawn: {', '.join(DRAWN)}"
            )
        self.terrain, self.terrain_seed = terrain, terrain_seed
        self._scene = {"seed": terrain_seed} | SCENES.get(terrain, {})
        self.sparse, self.rate = sparse, rate
        self._climbs = terrain in CLIMBED
        self._centre = MIDDLE if self._climbs else CENTRE
        self._sees = terrain != "flat" and not blind
        tick, physics = tick_of(fidelity, rate), fidelity != "kinematic"
        model = self._model(visuals=False)
        robot = hurcules.Robot(model)
        robot.set_keyframe("drive")
        self._qpos = _climbing(model, robot.qpos) if self._climbs else robot.qpos.copy()
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
            size, text = len(AHEAD) * len(BESIDE), "heights of the ground about the robot"
            self.observation += (Group("ground", size, "m", 1.0, text),)
        self.units = {"drive": ("m/s", "rad/s"), "legs": "rad/s"}
        self.actions = {"drive": np.array([SPEED, YAW_RATE]), "legs": LEGS}
        self.components = {"legs": ("legs",)} if self._climbs else {}
        controller = self._controller(robot, model, action, tick, physics=physics)
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
        self,
        plan: hurcules.Robot,
        model: mujoco.MjModel,
        action: str,
        tick: float,
        *,
        physics: bool,
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
            [first, hurcules.PostureTask("posture", plan)],
            channels,
            dt=tick,
            base="sensed",
            drive=hurcules.DriveOptions(),
            torque_scaling=physics,
        )

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
            goal = (x + far, y + generator.uniform(-wide, wide), heading)
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
            self._keep_on(way, memory, numbers.dt)
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
        if self._sees:
            seen["ground"] = self._ground(achieved, numbers)
        return seen

    def _ground(self, place: Array, numbers: Numbers) -> Array:
        """Heights [m] about the robot over the soles of its tracks at the knees."""
        return self._heights.around(place, numbers["position/upper_legs"][:, 2:] - RADIUS)

    @cached_property
    def _heights(self) -> Heights:
        return Heights(hurcules.scenes.make(self.terrain, **self._scene))

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
        """Actions (n, 3) of a smooth law for unicycles (Park and Kuipers, ICRA 2011).

        On terrain it follows the goal's own line, where it climbs tail first (`_climb`).
        """
        if self._climbs:
            return np.clip(self._climb(numbers), -1.0, 1.0)
        seen = self.observe(numbers)["goal"]
        if self.terrain != "flat":
            speed, rate = _along(seen[:, :2], seen, 0.8)
            action = np.stack([speed / SPEED, rate / YAW_RATE, np.zeros_like(rate)], axis=1)
            return np.clip(action, -1.0, 1.0)
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

    def _climb(self, numbers: Numbers) -> Array:
        """Tail first: the upper legs over what is ahead, the lower ones on what is behind.

        What is held straightens, lifts its tail higher, and backs off to come again beside it.
        """
        seen, memory = self.observe(numbers), numbers.memory
        roll = np.arcsin(np.clip(seen["up"][:, 1], -1.0, 1.0))
        ground = self._ground(self.goals(numbers)[0], numbers)
        scan = ground.reshape(-1, len(AHEAD), len(BESIDE))
        scan = scan - np.tan(roll)[:, None, None] * BESIDE
        ahead = -AHEAD - self._centre  # [m] of the knees
        on, off = (ahead > 0.1) & (ahead < 1.0), (ahead < -0.15) & (ahead > -0.95)
        tracks = np.maximum(scan[:, on, 2], scan[:, on, 6])
        height = np.maximum(tracks, scan[:, on, 3:6].max(axis=2) - BATTERY) + CLEAR
        over = np.arctan2(height, np.minimum(ahead[on], TAIL)).max(axis=1)
        behind = scan[:, off][:, :, [0, 1, 7, 8]].max(axis=2)
        lying = -np.arctan2(behind, -ahead[off]).max(axis=1) - 0.1  # where the lower legs meet it
        knee, rise = seen["legs"][:, 0], np.arcsin(np.clip(-seen["up"][:, 0], -1.0, 1.0))
        bend = over - np.maximum(rise - np.pi + knee, lying)
        phase = np.minimum(memory["held"][:, 0] // HELD, 3)
        bend = np.where(phase % 2 == 1, STRAIGHT, bend + np.where(phase == 2, HIGHER, 0.0))
        missing = np.pi - np.clip(bend, STRAIGHT, RAISED) - knee
        pace = np.clip(1.0 - np.abs(missing) / 0.15, np.where(phase > 0, 0.5, 0.0), 1.0)
        speed, rate = _along(-seen["goal"][:, :2], seen["goal"], 0.4, memory["aside"][:, 0])
        retreats = phase == 3
        speed = np.where(retreats, -0.3, speed * pace)
        rate = np.where(retreats, 1.5 * np.arctan2(seen["goal"][:, 3], seen["goal"][:, 2]), rate)
        return np.stack([-speed / SPEED, rate / YAW_RATE, 6.0 * missing / LEGS], axis=1)

    def _keep_on(self, way: Array, memory: Mapping[str, Array], dt: float) -> None:
        """For how long what climbs is held, and how far beside its line it tries then."""
        nearest, held, edge, tries, aside = (memory[name][:, 0] for name in HOLDS)
        onward = way < nearest - 0.02
        held[:] = np.where(onward, 0.0, held + dt)
        nearest[:] = np.where(onward, way, nearest)
        begins = (held > 3 * HELD) & (edge != nearest)
        edge[begins] = nearest[begins]
        tries[begins] += 1
        aside[begins] = np.where(tries % 2 == 1, ASIDE, -ASIDE)[begins]
        over = (held > 3 * HELD) & (way > nearest + 0.4) | (held > 3 * HELD + 3.5)
        held[over], nearest[over] = 0.0, way[over]
        free = way < edge - 0.55
        aside[free], edge[free] = 0.0, 0.0

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
        ground = 0.0 if self.terrain == "flat" else self._heights.at(np.array([x, y]))
        z = 0.3 + float(np.nan_to_num(ground))
        add_arrow(scene, (x, y, z), (x + 0.8 * cosine, y + 0.8 * sine, z), 0.05, (0, 0.8, 0, 1))

    def _model(self, visuals: bool) -> mujoco.MjModel:
        return hurcules.models.load(
            "rescue", self.terrain, bed=False, visuals=visuals, **self._scene
        )

    def command(self, action: Mapping[str, Array], numbers: Numbers) -> Mapping[str, Array]:
        """Where it climbs, the trunk turns with the knees: it stays leant over the lower legs."""
        if not self._climbs or "legs" not in action:
            return action
        return {"drive": action["drive"], "climb": np.repeat(action["legs"], 2, axis=1)}


def _climbing(model: mujoco.MjModel, qpos: Array) -> Array:
    """Where it starts to climb: looking back, its lower legs turned over to the front."""
    there = qpos.copy()
    there[3:7] = quaternion(np.array([0.0, 0.0, np.pi]))
    for joint, angle in CLIMBING.items():
        there[model.joint(joint).qposadr[0]] = angle
    return there


def _into(forward: Array, vector: Array) -> Array:
    """Planar vectors (n, 2) along a heading (n, 2) and to its left."""
    along = np.einsum("ni,ni->n", forward, vector)
    left = forward[:, 0] * vector[:, 1] - forward[:, 1] * vector[:, 0]
    return np.stack([along, left], axis=1)


def _along(way: Array, goal: Array, most: float, aside: Array | float = 0.0) -> tuple[Array, Array]:
    """Speed [m/s] and yaw rate [rad/s] along the goal's own line.

    Args:
        way: (n, 2) [m] to the goal, ahead and to the left of where it drives to.
        goal: (n, 4) as it is seen.
        most: of the speed [m/s].
        aside: [m] to the left of the line to keep to.
    """
    turn, x = np.arctan2(goal[:, 3], goal[:, 2]), way[:, 0]
    there = np.abs(x) < 0.1
    left = np.cos(turn) * way[:, 1] - np.sin(turn) * x + aside
    turn = turn + np.where(x > 0.1, np.clip(1.5 * left, -0.4, 0.4), 0.0)
    speed = np.where(there, 0.0, np.clip(x, -0.25, most))
    return speed, np.where(there & (np.abs(turn) < 0.15), 0.0, 1.5 * turn)


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
