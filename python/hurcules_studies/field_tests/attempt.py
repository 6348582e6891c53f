"""One repetition of a test method: there, waiting if the method wants so, and back."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from hurcules import Drive, DriveOptions, Error, FallOptions, Simulation, driving, scenes
from hurcules_studies.field_tests.climbing import ARMS, SLOW
from hurcules_studies.field_tests.course import Course, Leg, Straight, make_course
from hurcules_studies.field_tests.grasp import Grasp
from hurcules_studies.field_tests.lift import Lift
from hurcules_studies.field_tests.line_driver import LineDriver, yaw_of
from hurcules_studies.field_tests.methods import Method
from hurcules_studies.field_tests.postures import (
    JOINTS,
    POSTURE,
    Plan,
    Posture,
    PostureMover,
    angles,
)

__all__ = ["Repetition", "Stopped", "Variation", "Watch", "repeat"]


class Stopped(Exception):
    """A repetition was ended before its end."""


# model, its state and the speed [m/s] that is wanted; returns the speed [m/s] and the yaw rate
# [rad/s] that the drives are commanded
Driver = Callable[[mujoco.MjModel, mujoco.MjData, float], tuple[float, float]]
# called at each period with the model and its state: a film takes its pictures here
Watch = Callable[[mujoco.MjModel, NDArray[np.float64], float], None]

# fallen is whose legs tilt so far: the upper ones, or the lower ones where these lie in front of
# them, for then the upper legs are raised to climb
TIPPED = FallOptions("upper_legs", max_tilt=math.radians(60))
PATIENCE = 2.5  # times the time that the way takes at the speed
TURN_TIME = 20.0  # [s] for half a turn in place
TURNED = 0.1  # [rad] and less is left to keeping to the line
CLOSING = 1.0  # [s] for the fingers
GRACE = 5.0  # [s] on top, and at most to come to a stop


@dataclass(frozen=True)
class Variation:
    """What differs between repetitions; everything is drawn evenly from both sides."""

    friction: tuple[float, float] = (0.8, 1.0)  # factor on the ground's own
    payload: float = 20.0  # [kg] up to this on the trunk
    offset: float = 0.05  # [m] of the start, left or right
    yaw: float = 0.03  # [rad] of the start


USUAL = Variation()
_DRIVES = DriveOptions()
CHANNELS = {"drive": Drive(_DRIVES.max_speed, _DRIVES.max_yaw_rate), "posture": POSTURE}


@dataclass(frozen=True)
class Repetition:
    """One attempt."""

    seed: int
    # "" for none; "tip-over", "stuck", "off the lane", "slipped", "lost grip", "simulation"
    fault: str
    seconds: float
    x: float  # [m] where it ended
    metres: float  # way of the base over ground, as far as it came
    # [J] of mechanical work of both drives; what they brake does not come back
    drive_energy: float


def repeat(
    chosen: Method,
    setting: float | None,
    robot: str,
    seed: int,
    speed: float | None = None,
    driver: Driver | None = None,
    variation: Variation = USUAL,
    watch: Watch | None = None,
    stopped: Callable[[], bool] = lambda: False,
) -> Repetition:
    """Makes one attempt.

    Args:
        chosen: the method.
        setting: of its parameter; None for terrain with one setting.
        robot: one of `hurcules.models.names()`.
        seed: draws friction, payload, start and terrain.
        speed: [m/s] there, and back; by default the method's own.
        driver: commands the drives, in every tick of 2 ms; by default a `LineDriver`.
        variation: what differs between repetitions.
        watch: is shown every state.
        stopped: whether to end early, asked in every period.

    Raises:
        Stopped: it was ended early.
        Error: no such robot or setting, or a driver that answers no speed and yaw rate.
    """
    rng = np.random.default_rng(seed)
    values = chosen.values(setting)
    scene = scenes.scene(chosen.scene, **values)
    values["friction"] = scene.friction * rng.uniform(*variation.friction)
    model = scenes.load(chosen.scene, robot, seed=seed, **values)
    model.body_mass[model.body("torso").id] += rng.uniform(0.0, variation.payload)
    course = make_course(chosen, setting, scene, speed)
    plan = chosen.plan(scene)
    start = mujoco.MjData(model)
    _place(model, start, rng, variation, course.legs[0].heading)
    arms = ARMS.items() if chosen.climbs else ()
    for joint, angle in (*arms, *zip(JOINTS, angles(plan(0.0)), strict=True)):
        start.joint(joint).qpos[0] = angle
    grasp = Grasp(model, start) if chosen.grasps else None
    simulation = driving.simulation(
        model,
        start.qpos,
        channels=CHANNELS,
        support="lower_leg_L" if chosen.climbs else "",
        fall=TIPPED,
    )
    options = simulation.controller.drive.options
    operator = driver or LineDriver(options, course.path)
    attempt = _Attempt(simulation, course, operator, plan, grasp, watch, stopped)
    fault = attempt.make()
    data = simulation.data
    x = float(data.qpos[0])
    return Repetition(seed, fault, float(data.time), x, attempt.metres, attempt.energy)


class _Attempt:
    """A robot under way."""

    def __init__(
        self,
        simulation: Simulation,
        course: Course,
        driver: Driver,
        plan: Plan,
        grasp: Grasp | None,
        watch: Watch | None,
        stopped: Callable[[], bool],
    ) -> None:
        self.stopped = stopped
        self.simulation, self.course = simulation, course
        self.model, self.data = simulation.model, simulation.data
        self.driver, self.plan, self.watch, self.grasp = driver, plan, watch, grasp
        self.metres = self.energy = 0.0
        self._warnings = self.data.warning.number  # a view: going through the list takes 0.1 ms
        self._posture = plan(0.0)
        self.mover = PostureMover(simulation, self._posture)
        self._motors = [self.model.actuator(f"{side}_drive").id for side in "LR"]

    def make(self) -> str:
        """Drives the whole course; returns the fault, "" for none."""
        if self.grasp and (fault := self._take_hold(self.grasp)):
            return fault
        for leg in self.course.legs:
            if fault := self._turn(leg):
                return fault
            self._lift = Lift()
            limit = self.data.time + PATIENCE * leg.length / abs(leg.speed) + GRACE
            furthest = leg.place(float(self.data.qpos[0]))
            while not leg.done(self.data.qpos):
                furthest = leg.further(furthest, leg.place(float(self.data.qpos[0])))
                self._posture = self._lifted(self.plan(furthest), leg)
                if fault := self._tick(self._speed(leg)):
                    return fault
                if self.data.time > limit:
                    return "stuck"
            if leg.hold and (fault := self._hold(leg.hold)):
                return fault
        return ""

    def _lifted(self, posture: Posture, leg: Leg) -> Posture:
        """The posture of an operator who gets free where he is stuck; turns the way with him."""
        if not self.course.lifts:
            return posture
        x, y = leg.onward * self.data.qpos[:2]
        ready = self.mover.pace == 1.0
        posture = self._lift(posture, float(x), float(y), self.data.time, ready)
        if isinstance(self.course.path, Straight):
            # also tail first: what leads swings left when the robot turns left
            self.course.path.heading = leg.heading + self._lift.retreat.slant
        return posture

    def _speed(self, leg: Leg) -> float:
        """The speed wanted now [m/s], < 0 tail first."""
        pace = self.mover.pace * min(abs(leg.speed), self._posture.speed)
        if self._lift.retreat.backs_off:
            pace = -min(pace, SLOW)
        return math.copysign(1.0, leg.speed) * pace

    def _take_hold(self, grasp: Grasp) -> str:
        """Stands while the fingers close; returns the fault."""
        until = self.data.time + CLOSING
        while self.data.time < until:
            if fault := self._tick(0.0):
                return fault
        grasp.begin(self.data)
        return ""

    def _turn(self, leg: Leg) -> str:
        """Turns in place until the robot looks where it shall on this leg; returns the fault."""
        path = self.course.path
        if not isinstance(path, Straight) or path.heading == leg.heading:
            return ""
        path.heading = leg.heading
        until = self.data.time + TURN_TIME
        while abs(math.remainder(yaw_of(self.data) - leg.heading, 2 * math.pi)) > TURNED:
            if fault := self._tick(leg.speed):
                return fault
            if self.data.time > until:
                return "stuck"
        return ""

    def _hold(self, seconds: float) -> str:
        """Stops and stands still; returns the fault, also when the robot does not stay."""
        until = self.data.time + GRACE
        while self.data.time < until and np.abs(self.data.qvel[:6]).max() > 0.02:
            if fault := self._tick(0.0):
                return fault
        start, until = self.data.qpos[:2].copy(), self.data.time + seconds
        while self.data.time < until:
            if fault := self._tick(0.0):
                return fault
        return "slipped" if np.hypot(*(self.data.qpos[:2] - start)) > 0.1 else ""

    def _tick(self, speed: float) -> str:
        if self.stopped():
            raise Stopped
        data, start = self.data, self.data.qpos[:2].copy()
        if self.grasp:
            self.grasp.close(self.simulation)
        drive = _pair(self.driver(self.model, data, speed))
        self.simulation.step(1, {"drive": drive, "posture": self.mover(self._posture)})
        self.metres += math.hypot(*(data.qpos[:2] - start))
        power = data.actuator_force[self._motors] * data.actuator_velocity[self._motors]
        self.energy += float(np.maximum(power, 0.0).sum()) * self.simulation.dt
        if self.watch:
            self.watch(self.model, data.qpos, data.time)
        if self._warnings.any():
            return "simulation"
        if self.simulation.finished:
            return "tip-over" if "fell" in self.simulation.reason else "simulation"
        if self.grasp and self.grasp.lost(data):
            return "lost grip"
        return "" if self.course.on_lane(data.qpos) else "off the lane"


def _pair(answer: object) -> tuple[float, float]:
    """What a driver answers.

    Raises:
        Error: it answers something else.
    """
    if not (isinstance(answer, tuple | list | np.ndarray) and len(answer) == 2):
        raise Error(
            "driver: wanted the speed [m/s] and yaw rate [rad/s] that the drives are commanded, "
            f"got {answer!r}; the closed loop gives the torques"
        )
    return float(answer[0]), float(answer[1])


def _place(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    rng: np.random.Generator,
    variation: Variation,
    heading: float,
) -> None:
    mujoco.mj_resetDataKeyframe(model, data, model.key("drive").id)
    data.qpos[1] = rng.uniform(-variation.offset, variation.offset)
    yaw = heading + rng.uniform(-variation.yaw, variation.yaw)
    data.qpos[3:7] = math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)
