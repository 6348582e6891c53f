"""Runs a test method: repetitions at a setting, then the next harder one, until one is not passed.

A repetition goes from the start over the obstacle until the whole robot is behind it, waits if the
method wants so, and comes back in reverse. A fault ends it and is logged; the next one begins at
the start again.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass

import mujoco
import numpy as np

from hurcules import scenes
from hurcules._core import Error, step
from hurcules.trials.drive import StraightDriver, hold_joints
from hurcules.trials.methods import Method, method
from hurcules.trials.reliability import confidence, lower_bound

__all__ = ["Repetition", "Result", "SettingResult", "Variation", "repeat", "run"]

Driver = Callable[[mujoco.MjModel, mujoco.MjData, float], None]

PERIOD = 10  # steps of 1 ms between two calls of the driver
LENGTH = 1.2  # [m] the rear of the robot behind its base, and some room
TIPPED = math.radians(60)
PATIENCE = 2.5  # times the time that the way takes at the speed


@dataclass(frozen=True)
class Variation:
    """What differs between repetitions; everything is drawn evenly from both sides."""

    friction: tuple[float, float] = (0.8, 1.0)  # factor on the ground's own
    payload: float = 20.0  # [kg] up to this on the trunk
    offset: float = 0.05  # [m] of the start, left or right
    yaw: float = 0.03  # [rad] of the start


@dataclass(frozen=True)
class Repetition:
    """One attempt."""

    seed: int
    fault: str  # "" for none; "tip-over", "stuck", "off the lane", "simulation"
    seconds: float
    x: float  # [m] where it ended


@dataclass(frozen=True)
class SettingResult:
    """All attempts at one setting."""

    setting: float | None
    repetitions: int
    failures: int
    confidence_80: float
    confidence_90: float
    lower_bound_95: float
    metres_per_minute: float  # mean over the successful ones, there and back; 0 without one
    faults: list[Repetition]


@dataclass(frozen=True)
class Result:
    """What a method found."""

    method: str
    title: str
    robot: str
    parameter: str
    largest: float | None  # hardest setting that was passed; None for none, or without settings
    passed: bool  # at least one setting
    settings: list[SettingResult]

    def as_dict(self) -> dict[str, object]:
        """For JSON."""
        return asdict(self)


def run(
    name: str,
    robot: str = "rescue",
    *,
    repetitions: int = 10,
    seed: int = 0,
    settings: tuple[float, ...] | None = None,
    speed: float = 0.6,
    driver: Driver | None = None,
    variation: Variation = Variation(),
) -> Result:
    """Runs a method until a setting is not passed.

    Args:
        name: one of `METHODS`.
        robot: one of `hurcules.models.names()`.
        repetitions: at each setting; one failure fails the setting.
        seed: draws friction, payload, start and terrain.
        settings: instead of the method's own.
        speed: [m/s] there, and back.
        driver: writes the torques of the drives; by default a `StraightDriver`.
        variation: what differs between repetitions.

    Raises:
        Error: no such method or robot, or a bad number.
    """
    chosen = method(name)
    if repetitions < 1 or not speed > 0.0:
        wanted = "wanted repetitions >= 1 and a speed > 0"
        raise Error(f"{name}: {wanted}, got {repetitions} and {speed!r}")
    results: list[SettingResult] = []
    for setting in (settings or chosen.settings) if chosen.parameter else (None,):
        tries = [
            repeat(chosen, setting, robot, 1000 * seed + i, speed, driver, variation)
            for i in range(repetitions)
        ]
        results.append(_sum_up(chosen, setting, tries))
        if results[-1].failures:
            break
    passed = [one for one in results if not one.failures]
    largest = passed[-1].setting if passed else None
    return Result(name, chosen.title, robot, chosen.parameter, largest, bool(passed), results)


def repeat(
    chosen: Method,
    setting: float | None,
    robot: str,
    seed: int,
    speed: float = 0.6,
    driver: Driver | None = None,
    variation: Variation = Variation(),
) -> Repetition:
    """Makes one attempt; arguments as for `run`."""
    rng = np.random.default_rng(seed)
    values = chosen.values(setting)
    scene = scenes.scene(chosen.scene, **values)
    values["friction"] = scene.friction * rng.uniform(*variation.friction)
    model = scenes.load(chosen.scene, robot, seed=seed, **values)
    hold_joints(model)
    model.body_mass[model.body("torso").id] += rng.uniform(0.0, variation.payload)
    data = mujoco.MjData(model)
    _place(model, data, rng, variation)
    data.joint("HIP").qpos[0] = chosen.lean
    mujoco.mj_forward(model, data)
    attempt = _Attempt(model, data, driver or StraightDriver(), speed)
    goal = scene.end + LENGTH
    fault = attempt.go(goal) or attempt.wait(chosen.hold) or attempt.go(0.0)
    return Repetition(seed, fault, float(data.time), float(data.qpos[0]))


class _Attempt:
    """A robot under way."""

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, driver: Driver, speed: float
    ) -> None:
        self.model, self.data, self.driver, self.speed = model, data, driver, speed

    def go(self, goal: float) -> str:
        """Drives until the base is at x = goal [m]; returns the fault, "" for none."""
        way = goal - float(self.data.qpos[0])
        direction = math.copysign(1.0, way)
        limit = self.data.time + PATIENCE * abs(way) / self.speed + 5.0
        while direction * (goal - self.data.qpos[0]) > 0.0:
            if fault := self._tick(direction * self.speed):
                return fault
            if self.data.time > limit:
                return "stuck"
        return ""

    def wait(self, seconds: float) -> str:
        """Stands still; returns the fault, also when the robot does not stay."""
        start, until = float(self.data.qpos[0]), self.data.time + seconds
        while self.data.time < until:
            if fault := self._tick(0.0):
                return fault
        return "slipped" if abs(float(self.data.qpos[0]) - start) > 0.1 else ""

    def _tick(self, speed: float) -> str:
        self.driver(self.model, self.data, speed)
        step(self.model, self.data, PERIOD)
        if any(warning.number for warning in self.data.warning):
            return "simulation"
        if self.data.body("upper_legs").xmat[8] < math.cos(TIPPED):
            return "tip-over"
        return "off the lane" if abs(float(self.data.qpos[1])) > 1.2 else ""


def _place(
    model: mujoco.MjModel, data: mujoco.MjData, rng: np.random.Generator, variation: Variation
) -> None:
    mujoco.mj_resetDataKeyframe(model, data, model.key("drive").id)
    data.qpos[1] = rng.uniform(-variation.offset, variation.offset)
    yaw = rng.uniform(-variation.yaw, variation.yaw)
    data.qpos[3:7] = math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)


def _sum_up(chosen: Method, setting: float | None, tries: list[Repetition]) -> SettingResult:
    faults = [one for one in tries if one.fault]
    n, f = len(tries), len(faults)
    way = 2 * (scenes.scene(chosen.scene, **chosen.values(setting)).end + LENGTH)
    rates = [60.0 * way / one.seconds for one in tries if not one.fault]
    bounds = confidence(n, f, 0.8), confidence(n, f, 0.9), lower_bound(n, f)
    return SettingResult(setting, n, f, *bounds, float(np.mean(rates)) if rates else 0.0, faults)
