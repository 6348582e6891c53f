"""Hurcules/Stretch-v1: both lower arms reach forward to goals before a person on the ground."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules import lift, mjcf, scenes
from hurcules.validation import require_known
from hurcules_envs.commands import TWINS, by_joints
from hurcules_envs.contact import view
from hurcules_envs.drawing import add_ball
from hurcules_envs.environment import Array, Environment, Group, Numbers, Start, tick_of

__all__ = ["Stretch"]

DISTANCE, LATERAL, DEPTH = 2.72, -0.05, 0.11  # [m] of the person's middle in the mission `stretch`
AHEAD, ASIDE, YAW = (-0.28, -0.05), 0.08, 0.15  # [m], [m], [rad] that differ between episodes
GAP, APART, HIGH = (0.41, 0.50), 0.33, (0.10, 0.22)  # [m] of goals: before him, aside, up
LATERALLY = 0.04  # [m] that goals differ to the side
POSTURE = {"KN": 0.02, "HIP": 0.02, "WST": 0.03, "NKY": 0.1, "NKP": 0.1}  # [rad] of the start
ARM = 0.04  # [rad] of the arms
SPEED, PITCH, GAZE = 0.15, 0.2, 0.3  # [m/s], [rad/s], [rad/s] full scale
NEAR, SEES, HOLD = 0.03, 0.15, 0.5  # [m], [rad], [s] of success
PAST, PRESSED = 0.2, 100.0  # [m] behind a goal, [N] on the person: missed
FREE = 0.02  # [m] between parts of the robot
TILT = 0.35  # [rad] of a robot that falls


class Stretch(Environment):
    """The rescue robot reaches for a person who lies before it, and looks at the chest.

    It is the stretch of the thesis (section 4.4) with its hierarchy, joint < distances from itself
    < hands < pitch < pelvis < gaze, as a task that wants to be learnt: goals, place and heading of
    the person and the posture of the start differ between episodes, and a command that always
    drives ahead misses. The person lies still, as if frozen: he can be struck, not moved. Axes are
    the world's: x forward, y left, z up.

    Actions, in [-1, 1]; zero holds:

    | index | name | scale | unit | what |
    |---|---|---|---|---|
    | 0 | left_x | 0.15 | m/s | reference of the left hand, forward |
    | 1 | left_y | 0.15 | m/s | to the left |
    | 2 | left_z | 0.15 | m/s | up |
    | 3 | right_x | 0.15 | m/s | reference of the right hand, forward |
    | 4 | right_y | 0.15 | m/s | to the left |
    | 5 | right_z | 0.15 | m/s | up |
    | 6 | left_pitch | 0.2 | rad/s | pitch of the left lower arm |
    | 7 | right_pitch | 0.2 | rad/s | pitch of the right lower arm |
    | 8 | pelvis | 0.15 | m/s | reference of the pelvis, forward |
    | 9 | gaze_0 | 0.3 | rad/s | line of sight of the head, to the left |
    | 10 | gaze_1 | 0.3 | rad/s | up |

    With the action "joint" these are the velocities of the coordinates' references, and the
    observation ends with the coordinates, without the lead.

    Observation:

    | index | name | bound | unit | what |
    |---|---|---|---|---|
    | 0-5 | way | 3 | m | from the left hand to its goal, from the right one |
    | 6-11 | velocity | 2 | m/s | of the left and the right hand |
    | 12-17 | lead | 0.5 | m | reference minus hand, of both |
    | 18-19 | pitch | 2 | rad | of the left and the right lower arm, tip up |
    | 20-22 | pelvis | 3 | m | where it is |
    | 23-24 | chest | 4 | rad | seen from the line of sight: to the left, up |
    | 25-26 | near | 3 | m | from each tip to the person's middle, along his depth |
    | 27 | margin | 2 | m | of the centre of mass within what the robot stands on |

    Reward:

    | term | what |
    |---|---|
    | progress | 10 a metre that the hands (their mean) came nearer to their goals |
    | gaze | 0.5 a radian that the line of sight came nearer to the chest |
    | effort | minus 0.02 times the mean square of the action |
    | success | 10 once |
    | missed | -5 once |
    | fall | -10 once |

    Success: for half a second both hands were nearer than 30 mm to their goals and the line of
    sight nearer than 0.15 rad to the chest; it ends the episode. `missed` ends it too: a hand is
    0.2 m further ahead than its goal, or presses on the person with 100 N. So does a fall. `info`
    has `missed` and `fell`, 0 or 1.
    """

    task_description = "Reach both goals before the person and look at the chest."
    terms = ("progress", "gaze", "effort", "success", "missed", "fall")
    observation = (
        Group("way", 6, "m", 3.0, "from the left hand to its goal, from the right one"),
        Group("velocity", 6, "m/s", 2.0, "of the left and the right hand"),
        Group("lead", 6, "m", 0.5, "reference minus hand, of both"),
        Group("pitch", 2, "rad", 2.0, "of the left and the right lower arm, tip up"),
        Group("pelvis", 3, "m", 3.0, "where it is"),
        Group("chest", 2, "rad", 4.0, "seen from the line of sight: to the left, up"),
        Group("near", 2, "m", 3.0, "from each tip to the person's middle, along his depth"),
        Group("margin", 1, "m", 2.0, "of the centre of mass within what the robot stands on"),
    )
    memory: Mapping[str, int] = MappingProxyType(
        {
            "goal": 6, "person": 3, "way": 1, "sight": 1, "gained": 1, "seen": 1, "held": 1,
            "done": 1, "missed": 1, "fresh": 1, "fell": 1,
        }
    )  # fmt: skip
    parameters = ("person",)
    quantities = (
        "position/L_tcp", "position/R_tcp", "velocity/L_tcp", "velocity/R_tcp", "matrix/L_tcp",
        "matrix/R_tcp", "target/left", "target/right", "value/left", "value/right",
        "position/pelvis", "position/gaze", "matrix/gaze", "position/casualty_chest",
        "contact_force/casualty_pelvis", "monitor/static_margin_m",
    )  # fmt: skip

    def __init__(
        self,
        fidelity: str = "exact",
        sparse: bool = False,
        rate: float = 20.0,
        action: str = "twist",
    ) -> None:
        """Builds robot, person, controller and loop.

        Args:
            fidelity: "exact", "fast" or "kinematic".
            sparse: reward of the ends alone.
            rate: steps a second [Hz].
            action: "twist" (the table), or "joint", velocities of coordinates, for comparison.

        Raises:
            hurcules.Error: a value that does not exist or is out of range.
        """
        tick = tick_of(fidelity, rate)
        require_known("action", action, TWINS)
        self.sparse, self.rate, self._action = sparse, rate, action
        self.units = {
            "left": "m/s", "right": "m/s", "left_pitch": "rad/s", "right_pitch": "rad/s",
            "pelvis": "m/s", "gaze": "rad/s",
        }  # fmt: skip
        self.actions = {
            "left": SPEED, "right": SPEED, "left_pitch": PITCH, "right_pitch": PITCH,
            "pelvis": SPEED, "gaze": GAZE,
        }  # fmt: skip
        model = mjcf.compile(mjcf.without_visuals(self._spec()))
        robot = hurcules.Robot(model)
        robot.set_keyframe("stretch")
        robot.stand_on(lift.SUPPORT)
        controller = self._controller(robot, tick, physics=fidelity != "kinematic")
        self.simulation = hurcules.Simulation(
            model=hurcules.models.with_timestep(model, tick),
            controller=controller,
            record=False,
            physics=fidelity != "kinematic",
            loaded_springs=True,
            fall=hurcules.FallOptions("pelvis", max_tilt=TILT),
        )
        self._robot, self._posture = robot, robot.configuration
        self._turn = np.array(model.body("casualty_pelvis").quat)

    @staticmethod
    def _spec() -> mujoco.MjSpec:
        """The robot before a person without joints."""
        spec = scenes.make(
            "casualty", robot="rescue", mass=75, lying="back", distance=DISTANCE, lateral=LATERAL
        )
        for sensor in list(spec.sensors):
            if sensor.name.startswith("casualty_"):
                spec.delete(sensor)
        for joint in list(spec.joints):
            if joint.name.startswith("casualty_"):
                spec.delete(joint)
        return spec

    def _controller(self, plan: hurcules.Robot, tick: float, *, physics: bool) -> Any:
        limits = hurcules.JointLimits("joint", plan)
        for name, (lower, upper) in hurcules.mode_ranges("rescue_ready").items():
            limits.set_range(name, lower, upper)
        apart = hurcules.self_collision(plan, margin=FREE, most=FREE + 0.1, postures=2000)
        hands = [hurcules.PositionTask(n, plan, f) for n, f in _HANDS.items()]
        for hand in hands:
            hand.max_lead = 0.1
        pitch = [hurcules.AngleTask(f"{n}_pitch", plan, f) for n, f in _HANDS.items()]
        pelvis = hurcules.PositionTask("pelvis", plan, "pelvis", axes=[[1.0, 0.0, 0.0]])
        gaze = hurcules.GazeTask("gaze", plan, "gaze")
        tasks = [*hands, *pitch, pelvis, gaze]
        levels: list[Any] = [limits, apart, hands, pitch, pelvis, gaze]
        channels: Any = {t.name: hurcules.Twist(t, self.actions[t.name]) for t in tasks}
        if self._action == "joint":
            joints, channels = by_joints(self, plan, channels, {})
            levels.insert(2, joints)
        return hurcules.WholeBodyController(
            plan,
            levels,
            channels,
            dt=tick,
            support=lift.SUPPORT,
            torque_scaling=physics,
        )

    def configure(self, model: mujoco.MjModel, values: Mapping[str, Array]) -> None:
        """Place [m] and heading [rad] of the person."""
        x, y, yaw = values["person"]
        body = model.body("casualty_pelvis")
        body.pos[:] = x, y, DEPTH
        turn = np.array([math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)])
        mujoco.mju_mulQuat(body.quat, turn, self._turn)

    def start(self, generator: np.random.Generator) -> Start:
        """A posture near that of the mission, a person ahead, goals before him."""
        reach = [
            POSTURE.get(one.name, ARM) * generator.uniform(-1.0, 1.0)
            for one in self._robot.coordinates
        ]
        q = self._posture + np.array(reach)
        lower = [one.lower for one in self._robot.coordinates]
        upper = [one.upper for one in self._robot.coordinates]
        self._robot.set_configuration(np.clip(q, lower, upper))
        qpos = np.array(self._robot.qpos)
        hands = [self._robot.position(frame) for frame in _HANDS.values()]
        x, y = DISTANCE + generator.uniform(*AHEAD), LATERAL + generator.uniform(-ASIDE, ASIDE)
        yaw = generator.uniform(-YAW, YAW)
        c, s = math.cos(yaw), math.sin(yaw)
        goals = []
        for side in (APART, -APART):
            along = -generator.uniform(*GAP)
            across = side - LATERAL + generator.uniform(-LATERALLY, LATERALLY)
            height = generator.uniform(*HIGH)
            goals.append([x + c * along - s * across, y + s * along + c * across, height])
        way = float(np.linalg.norm(np.array(goals) - np.array(hands), axis=1).mean())
        # where it looks is known after the first step
        memory = {"goal": np.ravel(goals), "person": (x, y, yaw), "way": way, "sight": -1.0}
        told = {"person_x": float(x), "person_y": float(y), "person_yaw": float(yaw)}
        return Start(qpos, memory, told)

    def remember(self, numbers: Numbers) -> None:
        """What came nearer, and how the episode ends."""
        memory = numbers.memory
        ways = self._ways(numbers)
        way = np.linalg.norm(ways, axis=2).mean(axis=1)
        sight = np.linalg.norm(self._chest(numbers), axis=1)
        memory["gained"][:, 0] = memory["way"][:, 0] - way
        known = memory["sight"][:, 0] >= 0.0  # from the second step on
        memory["seen"][:, 0] = np.where(known, memory["sight"][:, 0] - sight, 0.0)
        memory["way"][:, 0], memory["sight"][:, 0] = way, sight
        there = (np.linalg.norm(ways, axis=2).max(axis=1) < NEAR) & (sight < SEES)
        numbers.hold(there, HOLD)
        past = (ways[:, :, 0] < -PAST).any(axis=1)
        pressed = numbers["contact_force/casualty_pelvis"][:, 0] > PRESSED
        memory["fell"][:, 0] = numbers.finished
        memory["missed"][:, 0] = (past | pressed) & ~numbers.finished

    def observe(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        hands = [numbers["position/L_tcp"], numbers["position/R_tcp"]]
        x, y, yaw = numbers["person"].T
        near = [np.cos(yaw) * (x - p[:, 0]) + np.sin(yaw) * (y - p[:, 1]) for p in hands]
        up = [np.clip(numbers[f"matrix/{frame}"][:, 6], -1.0, 1.0) for frame in _HANDS.values()]
        lead = [numbers[f"target/{name}"] - numbers[f"value/{name}"] for name in _HANDS]
        return {
            "way": self._ways(numbers).reshape(len(x), 6),
            "velocity": numbers.row("velocity/L_tcp", "velocity/R_tcp"),
            "lead": np.concatenate(lead, axis=1),
            "pitch": np.arcsin(np.stack(up, axis=1)),
            "pelvis": numbers["position/pelvis"],
            "chest": self._chest(numbers),
            "near": np.stack(near, axis=1),
            "margin": numbers["monitor/static_margin_m"],
        }

    def reward(self, numbers: Numbers) -> dict[str, Array]:
        """See the table."""
        shaped = 0.0 if self.sparse else 1.0
        effort = numbers.effort / numbers.action.shape[1]
        return {
            "progress": 10.0 * shaped * numbers["gained"][:, 0],
            "gaze": 0.5 * shaped * numbers["seen"][:, 0],
            "effort": -0.02 * shaped * effort,
            "success": 10.0 * numbers["fresh"][:, 0],
            "missed": -5.0 * numbers["missed"][:, 0],
            "fall": -10.0 * numbers["fell"][:, 0],
        }

    def succeeded(self, numbers: Numbers) -> NDArray[np.bool_]:
        """Hands and line of sight were where they are wanted."""
        return numbers["done"][:, 0] > 0.0

    def failed(self, numbers: Numbers) -> NDArray[np.bool_]:
        """Missed."""
        return numbers["missed"][:, 0] > 0.0

    def ended(self, numbers: Numbers) -> NDArray[np.bool_]:
        """Success ends an episode."""
        return self.succeeded(numbers)

    def tell(self, numbers: Numbers) -> dict[str, Array]:
        """How it ended."""
        return {"missed": numbers["missed"][:, 0], "fell": numbers["fell"][:, 0]}

    def expert(self, numbers: Numbers) -> Array:
        """Both hands straight to their goals, the head to the chest."""
        seen = self.observe(numbers)
        action = np.zeros((len(seen["way"]), 11))
        action[:, :6] = 2.0 * seen["way"] / SPEED
        action[:, 9:] = 2.0 * seen["chest"] / GAZE
        return np.clip(action, -1.0, 1.0)

    def camera(self) -> mujoco.MjvCamera:
        """From the front left."""
        return view((1.4, 0.0, 0.55), 4.4, 128.0, -14.0)

    def visual_model(self) -> mujoco.MjModel:
        """The scene with all that is only seen."""
        return mjcf.compile(self._spec())

    def pictured(self, episodes: Any, i: int) -> tuple[mujoco.MjModel, mujoco.MjData]:
        """With the person of episode i."""
        if self._drawn is None:
            model = self.visual_model()
            self._drawn = model, mujoco.MjData(model)
        self.configure(self._drawn[0], {"person": episodes.memory["person"][i]})
        return super().pictured(episodes, i)

    def draw(self, episodes: Any, i: int, scene: mujoco.MjvScene) -> None:
        """The goals, as balls."""
        for goal in episodes.memory["goal"][i].reshape(2, 3):
            add_ball(scene, goal, NEAR, (0.1, 0.8, 0.2, 0.7))

    def _ways(self, numbers: Numbers) -> Array:
        """(n, 2, 3) [m] from the hands to their goals."""
        hands = numbers.row("position/L_tcp", "position/R_tcp")
        return (numbers["goal"] - hands).reshape(-1, 2, 3)

    def _chest(self, numbers: Numbers) -> Array:
        """(n, 2) [rad] where the chest is seen from the line of sight: to the left, up."""
        way = numbers["position/casualty_chest"] - numbers["position/gaze"]
        R = numbers["matrix/gaze"].reshape(-1, 3, 3)
        line = R[:, :, 0]
        yaw = np.arctan2(way[:, 1], way[:, 0]) - np.arctan2(line[:, 1], line[:, 0])
        level = np.hypot(way[:, 0], way[:, 1]), np.hypot(line[:, 0], line[:, 1])
        pitch = np.arctan2(way[:, 2], level[0]) - np.arctan2(line[:, 2], level[1])
        return np.stack([(yaw + np.pi) % (2.0 * np.pi) - np.pi, pitch], axis=1)


_HANDS = {"left": "L_tcp", "right": "R_tcp"}
