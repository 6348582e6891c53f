"""Hurcules/Reach-v0 and ReachPrecise-v0: the hands of a robot go to where they are wanted."""

from __future__ import annotations

from collections.abc import Sequence
from numbers import Real
from typing import Any, NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules import _core
from hurcules_envs.commands import channel_of, joint_channel
from hurcules_envs.drawing import add_ball
from hurcules_envs.environment import Array, Environment, Group, Numbers, Start, tick_of, told
from hurcules_envs.robots import MAX_ACCELERATION, load_robot, sample_postures
from hurcules_envs.rotations import quaternion, turn_between
from hurcules_envs.springs import softest_spring

__all__ = ["Reach", "ReachPrecise"]

HOLD = 0.5  # [s] at the goal
FAR = 1.2  # [m] a hand has to go at most: 4 s at full speed
NEAR = 0.1  # [m] over which nearness grows
EFFORT = 0.1
STIFF = 60.0  # [rad/s] a spring of a higher frequency is not felt at the policy's rate
TURN = 0.3  # [m/rad] what an angle counts in the reward
GAIN = 3.0  # [1/s] of the expert
SWING = ("plan", "plan_rate", "sway", "sway_rate")  # what is remembered of hands in springs
TILT = 0.35  # [rad] of what it stands on: it falls


class _Errors(NamedTuple):
    """Of hands."""

    distance: Array  # (n, h) [m]
    angle: Array | None  # (n, h) [rad]; None: hands may turn as they like
    within: NDArray[np.bool_]  # (n,) all of them


class Reach(Environment):
    """The hands reach goals that some posture without contact has.

    All goals can be reached at once from where the robot stands, and are 1.2 m away at most. Start
    and goal are two of 256 postures that a robot always has, so goals come again, and episodes too:
    of 800 seeds 242 goals and 790 episodes differ. An action moves the references of the hands;
    limits come before them, the posture gives way to them. Positions are in the world, whose axes
    are x forward, y left, z up at the start. h is the number of hands, 2 for Hurcules.

    Action: Box(-1, 1, (3 h,), float32), x, y, z of each hand. Zero holds.

    | action  | scale | what 1 means                                          |
    |---------|-------|-------------------------------------------------------|
    | "twist" | 0.3   | velocity of the reference [m/s]                       |
    | "delta" | 0.05  | reference beside the measured hand [m]                |
    | "pose"  | 2.0   | reference in the world [m]                            |
    | "joint" |       | velocity of each coordinate's reference [rad/s], (n,) |

    Observation: Dict. `observation` of shape (9 h,), and `achieved_goal`, `desired_goal` (3 h,).
    For the action "joint" the n coordinates [rad] stand in place of velocity and lead, (3 h + n,).

    | group    | size | unit | bound | what it is               |
    |----------|------|------|-------|--------------------------|
    | hand     | 3 h  | m    | 5     | hands in the world       |
    | velocity | 3 h  | m/s  | 5     | of the hands             |
    | lead     | 3 h  | m    | 5     | from hand to reference   |

    Reward: `distance`, minus the mean distance d of the hands [m]; `nearness`, the mean of
    1 - tanh(d / 0.1 m); `success`, 1 while all hands are within the tolerance; `effort`, minus
    0.1 times the mean square of the action. Success: they were at their goals for half a second.
    Nothing ends the episode but a fall.
    """

    task_description = "Bring each hand to its goal and hold it there."
    terms = ("distance", "nearness", "success", "effort")

    def __init__(
        self,
        fidelity: str = "exact",
        action: str = "twist",
        robot: str = "rescue",
        frames: Sequence[str] | None = None,
        joints: Sequence[str] | None = None,
        tolerance: float = 0.03,
        angle: float | None = None,
        sparse: bool = False,
        rate: float = 20.0,
        safe: bool = True,
    ) -> None:
        """Builds robot, controller and loop.

        Args:
            fidelity: "exact", "fast" or "kinematic".
            action: "twist", "delta" or "pose" of the hands, or "joint" for comparison.
            robot: "rescue", "manipulation" or the path of an MJCF file or a URDF.
            frames: of a path: the frames of its hands.
            joints: of a path: its coordinates.
            tolerance: [m] of each hand.
            angle: [rad] of each hand; None: hands may turn as they like.
            sparse: reward of success alone.
            rate: steps a second [Hz].
            safe: before the hands come distances of the robot from itself and the ground, and its
                balance; False leaves only the limits.

        Raises:
            hurcules.Error: a value that does not exist or is out of range.
        """
        for name, value in (("tolerance", tolerance), ("angle", 1.0 if angle is None else angle)):
            if not (isinstance(value, Real) and 0.0 < value < np.inf):
                raise hurcules.Error(f"{name}: wanted a number > 0, got {value!r}")
        self.setup = load_robot(robot, frames, joints)
        self.postures, self.bearers = sample_postures(self.setup), self.setup.hands
        self.tolerance, self.angle, self.sparse, self.rate = tolerance, angle, sparse, rate
        self._names = [f"hand_{i}" for i in range(len(self.setup.hands))]
        self._build(fidelity, action, tick_of(fidelity, rate), safe)
        h = len(self._names)
        self._size = 3 if angle is None else 7  # of a hand in the goal
        self.goal = self._size * h
        self.memory = {"goal": self.goal, "held": 1, "done": 1}
        self._swings = self._free_swing(1.0 / rate) if fidelity == "kinematic" else None
        if self._swings is not None:
            self.memory |= dict.fromkeys(SWING, 3 * h)
        self.quantities = tuple(
            [f"value/{name}" for name in self._names]
            + [f"rotation/{frame}" for frame in self.setup.hands]
        )
        self._values = self.quantities[:h]
        self.observation = (Group("hand", 3 * h, "m", 5.0, "hands in the world"),)
        self._joints = action == "joint"  # who commands them wants to see them
        if self._joints:
            self.quantities += ("q",)
            n = len(self.setup.joints)
            self.observation += (Group("joint", n, "rad", 10.0, "coordinates"),)
        else:
            self._velocities = tuple(f"velocity/{frame}" for frame in self.setup.hands)
            self._targets = tuple(f"target/{name}" for name in self._names)
            self.quantities += self._velocities + self._targets
            self.observation += (
                Group("velocity", 3 * h, "m/s", 5.0, "of the hands"),
                Group("lead", 3 * h, "m", 5.0, "from hand to reference"),
            )

    def start(self, generator: np.random.Generator) -> Start:
        """A posture to start from, another one whose hands are the goals."""
        postures = self.postures
        first = generator.integers(len(postures.qpos))
        ways = np.linalg.norm(postures.hands - postures.hands[first], axis=-1).max(axis=-1)
        others = np.flatnonzero((ways <= FAR) & (np.arange(len(ways)) != first))
        second = generator.choice(others) if len(others) else ways.argsort()[1]
        goal = postures.hands[second]
        if self.angle is not None:
            goal = np.concatenate([goal, quaternion(postures.turns[second])], axis=-1)
        memory = {"goal": goal.ravel()}
        if self._swings is not None:
            memory["plan"] = postures.hands[first].ravel()
        return Start(postures.qpos[first], memory)

    def remember(self, numbers: Numbers) -> None:
        """How the hands swing, and how long they have been at their goals."""
        if self._swings is not None:
            hands = self._swing(numbers, self._swings)
            numbers.once("hands", lambda: hands)
        numbers.hold(self._errors_now(numbers).within, HOLD)

    def observe(self, numbers: Numbers) -> dict[str, Array]:
        """The hands, and how they move; the goals stand beside them."""
        hands = self._hands(numbers)
        if self._joints:
            return {"hand": hands, "joint": numbers["q"]}
        velocity = numbers.row(*self._velocities)
        if self._swings is not None:
            velocity = velocity + numbers["sway_rate"]
        return {"hand": hands, "velocity": velocity, "lead": numbers.row(*self._targets) - hands}

    def goals(self, numbers: Numbers) -> tuple[Array, Array]:
        """Where the hands are, and where they are wanted."""
        if self.angle is None:
            return self._hands(numbers), numbers["goal"]
        return numbers.once("poses", lambda: self._poses(numbers)), numbers["goal"]

    def reward(self, numbers: Numbers) -> dict[str, Array]:
        """Distance, nearness, 1 for all hands within the tolerance, effort."""
        effort = numbers.effort * (-EFFORT * (not self.sparse) / numbers.action.shape[1])
        return self._terms(self._errors_now(numbers)) | {"effort": effort}

    def compute_reward(self, achieved: Array, desired: Array, info: Any) -> Array | float:
        """The reward of other goals, any leading axes; the effort is that of `info`.

        Args:
            achieved: (..., g).
            desired: (..., g).
            info: of a step, of several in a vector, or a sequence of those of single ones.
        """
        leading = np.shape(achieved)[:-1]
        goals = (np.reshape(goal, (-1, self.goal)) for goal in (achieved, desired))
        terms = self._terms(self._errors(*goals, rounded=False))
        reward = np.reshape(sum(terms.values()), leading) + told(info, "reward_effort")
        return float(reward) if np.ndim(reward) == 0 else reward

    def succeeded(self, numbers: Numbers) -> NDArray[np.bool_]:
        """All hands were at their goals for half a second."""
        return numbers["done"][:, 0] > 0.0

    def expert(self, numbers: Numbers) -> Array:
        """Actions (n, k) that lead each hand straight to its goal, for "twist"."""
        now, goal = (one.reshape(len(one), -1, self._size) for one in self.goals(numbers))
        parts = [(goal[..., :3] - now[..., :3]) / 0.3]
        if self.angle is not None:
            parts.append(turn_between(now[..., 3:], goal[..., 3:]) / 0.6)
        action = np.concatenate([part.reshape(len(part), -1) for part in parts], axis=1)
        action *= GAIN
        if self.angle is None:
            return np.clip(action, -1.0, 1.0)
        # place and turn of both hands arrive together
        return action / np.maximum(np.abs(action).max(axis=1, keepdims=True), 1.0)

    def visual_model(self) -> mujoco.MjModel:
        """The robot with its surfaces."""
        if self.setup.name in hurcules.models.names():
            return hurcules.models.load(self.setup.name, "flat", bed=self.setup.name != "rescue")
        return self.setup.model

    def camera(self) -> mujoco.MjvCamera:
        """Of Hurcules from the front left, head and hands within; of others as MuJoCo says."""
        camera = mujoco.MjvCamera()
        if not self.setup.drives:
            mujoco.mjv_defaultFreeCamera(self.setup.model, camera)
            return camera
        camera.lookat[:] = (0.4, 0.0, 0.9)
        camera.distance, camera.azimuth, camera.elevation = 4.8, 130.0, -15.0
        return camera

    def draw(self, episodes: Any, i: int, scene: mujoco.MjvScene) -> None:
        """The goals, as balls."""
        for goal in episodes.memory["goal"][i].reshape(-1, self._size):
            add_ball(scene, goal[:3], max(self.tolerance, 0.02), (0.1, 0.8, 0.2, 0.7))

    def _build(self, fidelity: str, action: str, tick: float, safe: bool) -> None:
        setup, plan = self.setup, self.setup.robot()
        # what is near by construction is seen where it stands at first
        first: list[Any] = [setup.limits(plan), *(setup.safety.levels(plan) if safe else [])]
        plan.set_qpos(self.postures.qpos[0])
        hands = [
            hurcules.PositionTask(name, plan, frame)
            for name, frame in zip(self._names, setup.hands, strict=True)
        ]
        posture = hurcules.PostureTask("posture", plan)
        if action == "joint":
            channels = {"joints": joint_channel(posture, plan)}
            levels = [*first, posture, hands]
        else:
            channels = {hand.name: channel_of(action, hand) for hand in hands}
            levels = [*first, hands, posture]
            if self.angle is not None:
                turns = [
                    hurcules.OrientationTask(f"{name}_turn", plan, frame)
                    for name, frame in zip(self._names, setup.hands, strict=True)
                ]
                channels |= {turn.name: channel_of(action, turn, turns=True) for turn in turns}
                levels.insert(-1, turns)
        self.actions = {name: scale for name, (_, scale, _) in channels.items()}
        self.units = {name: unit for name, (*_, unit) in channels.items()}
        controller = hurcules.WholeBodyController(
            plan,
            levels,
            {name: channel for name, (channel, *_) in channels.items()},
            dt=tick,
            support=setup.support,
            velocity=hurcules.VelocityControllerOptions(max_acceleration=MAX_ACCELERATION),
            torque_scaling=fidelity != "kinematic",
        )
        self.simulation = hurcules.Simulation(
            model=hurcules.models.with_timestep(setup.model, tick),
            controller=controller,
            record=False,
            physics=fidelity != "kinematic",
            loaded_springs=True,
            fall=hurcules.FallOptions(setup.support, max_tilt=TILT) if setup.support else None,
        )

    def _free_swing(self, dt: float) -> Array | None:
        """Of the spring that hands hang in, see `springs`; None: there is none to be felt."""
        model, data = self.setup.model, mujoco.MjData(self.setup.model)
        data.qpos[:] = self.setup.robot().qpos
        mujoco.mj_forward(model, data)
        spring = softest_spring(model, data)
        return None if spring is None or spring.frequency > STIFF else spring.free(dt)

    def _swing(self, numbers: Numbers, free: Array) -> Array:
        """Carries the deflections on by a step; where the hands are then."""
        memory = (numbers.memory[name] for name in SWING)
        return _core.swing(self._planned(numbers), free, numbers.dt, *memory)

    def _planned(self, numbers: Numbers) -> Array:
        return numbers.row(*self._values)

    def _hands(self, numbers: Numbers) -> Array:
        """(n, 3 h) [m] where the hands are; without physics, where springs let them be."""
        planned = self._planned(numbers)
        if self._swings is None:
            return planned
        return numbers.once("hands", lambda: planned + numbers["sway"])

    def _poses(self, numbers: Numbers) -> Array:
        """(n, 7 h) place and turn of each hand."""
        hands, parts = self._hands(numbers), []
        for i, frame in enumerate(self.setup.hands):
            parts += [hands[:, 3 * i : 3 * i + 3], quaternion(numbers[f"rotation/{frame}"])]
        return np.concatenate(parts, axis=1)

    def _errors_now(self, numbers: Numbers) -> _Errors:
        """Of the goals as they are seen, so that `compute_reward` of them gives the same bits."""
        return numbers.once("errors", lambda: self._errors(*self.goals(numbers), rounded=True))

    def _errors(self, one: Array, other: Array, *, rounded: bool) -> _Errors:
        distance = _core.distances(one, other, self._size, rounded)
        within = _core.all_below(distance, self.tolerance)
        if self.angle is None:
            return _Errors(distance, None, within)
        angle = 2.0 * np.arccos(_core.half_angle_cosines(one, other, self._size, rounded))
        return _Errors(distance, angle, within & _core.all_below(angle, self.angle))

    def _terms(self, errors: _Errors) -> dict[str, Array]:
        shaped = 0.0 if self.sparse else 1.0
        error = errors.distance
        if errors.angle is not None:
            error = error + TURN * errors.angle
        return {
            "distance": _core.means(error, -shaped),
            "nearness": _core.means(1.0 - np.tanh(error / NEAR), shaped),
            "success": errors.within.astype(np.float64),
        }


class ReachPrecise(Reach):
    """As `Reach`, within 10 mm, and 0.1 rad of the orientation too.

    The arms want seven joints each: by default the manipulation robot. The action goes on with the
    turning of each hand (rotation vector in the world, 0.6 rad/s for "twist"), the goals with the
    quaternion (w, x, y, z) of each hand.
    """

    task_description = "Bring each hand to its goal, turned as wanted, and hold it there."

    def __init__(
        self,
        fidelity: str = "exact",
        action: str = "twist",
        robot: str = "manipulation",
        frames: Sequence[str] | None = None,
        joints: Sequence[str] | None = None,
        tolerance: float = 0.01,
        angle: float = 0.1,
        sparse: bool = False,
        rate: float = 20.0,
        safe: bool = True,
    ) -> None:
        """See `Reach`."""
        super().__init__(
            fidelity, action, robot, frames, joints, tolerance, angle, sparse, rate, safe
        )
