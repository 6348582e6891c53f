"""Control ticks under random and bad commands: what is commanded beyond a limit, what throws.

Run:  python benchmarks/random_ticks.py [--ticks 200000] [--seed 0]

Robots: both forms of Hurcules and those that installed packages ship (arms.py). An episode of 1,000
ticks draws a robot, a law (velocity or acceleration), a period (1, 2, 5 ms), up to five levels of
tasks with rho 0 or 0.1. While it runs, about one tick in fifty brings an event: targets that jump
by up to 3 m, another order of levels, ranges that get narrower (with room to stop in) and wider,
other gains, numbers that are none as a target (an Error is due), or a task of one's own that
measures NaN for ten ticks (braking is due). Told: how far positions, velocities and changes of
velocity went beyond the robot's limits, exceptions that were not due, ticks on invalid input and
those of them that did not brake.
"""

from __future__ import annotations

import argparse
import warnings
from collections import Counter

import mujoco
import numpy as np
from arms import load, places
from numpy.typing import NDArray

import hurcules
import hurcules.rhqp

EPISODE = 1000
EVENT = 0.02  # a tick
ROOM = 0.3  # [rad] or [m], to stop in, of a range that gets narrower
PERIODS = (0.001, 0.002, 0.005)  # [s]
Array = NDArray[np.float64]


class Worst:
    """What went wrong, and how far."""

    def __init__(self) -> None:
        self.position = self.velocity = self.change = 0.0
        self.counts: Counter[str] = Counter()

    def look(self, episode: Episode, before: Array) -> None:
        """After a tick."""
        now, robot = episode.velocity(), episode.robot
        q, a = robot.configuration, episode.acceleration * episode.dt
        over = np.maximum(q - episode.upper, episode.lower - q).max()
        self.position = max(self.position, float(over))
        self.velocity = max(self.velocity, float((np.abs(now) - episode.fastest).max()))
        self.change = max(self.change, float((np.abs(now - before) - a).max()))
        self.counts["ticks"] += 1
        if not (np.isfinite(q).all() and np.isfinite(now).all()):
            self.counts["not finite"] += 1
        if episode.solution().status == hurcules.rhqp.Status.InvalidInput:
            self.counts["invalid input"] += 1
            if (np.abs(now) > np.maximum(np.abs(before) - 0.999 * a, 0.0) + 1e-12).any():
                self.counts["invalid input without braking"] += 1


class Episode:
    """A robot with a stack that changes."""

    def __init__(self, robot: hurcules.Robot, frames: list[str], rng: np.random.Generator) -> None:
        self.robot, self.rng = robot, rng
        self.dt = float(rng.choice(PERIODS))
        self.by_velocity = bool(rng.random() < 0.5)
        kind = "Velocity" if self.by_velocity else "Acceleration"
        options = getattr(hurcules, f"{kind}ControllerOptions")(dt=self.dt)
        self.acceleration = options.max_acceleration
        self.limits = hurcules.JointLimits("limits", robot)
        self.lower, self.upper = self.limits.lower, self.limits.upper
        self.fastest = self.limits.max_velocity
        self.bad = 0  # ticks that the own task measures no numbers
        self.points = [
            hurcules.PositionTask(f"point {i}", robot, str(frame))
            for i, frame in enumerate(rng.choice(frames, 2))
        ]
        self.tasks = [
            *self.points,
            hurcules.OrientationTask("turn", robot, str(rng.choice(frames))),
            hurcules.PostureTask("posture", robot),
            hurcules.CustomTask("own", robot, 1, self._measure),
        ]
        self.controller = getattr(hurcules, f"{kind}Controller")(robot, options)
        self.reorder()

    def _measure(self, robot: hurcules.Robot) -> tuple[Array, Array]:
        row = np.zeros((1, robot.size))
        row[0, 0] = 1.0 if self.bad <= 0 else np.nan
        self.bad -= 1
        return robot.configuration[:1], row

    def reorder(self) -> None:
        """Another stack."""
        order = self.rng.permutation(len(self.tasks))[: self.rng.integers(1, 6)]
        levels = [
            hurcules.StackLevel(
                self.tasks[i].name, [self.tasks[i]], float(self.rng.choice([0, 0.1]))
            )
            for i in order
        ]
        self.controller.set_stack(hurcules.Stack([self.limits, *levels]))

    def velocity(self) -> Array:
        """(n,) of the plan."""
        return self.controller.velocity if self.by_velocity else self.robot.velocity

    def solution(self) -> hurcules.Solution:
        """Of the last tick."""
        return self.controller.solution

    def event(self, worst: Worst) -> None:
        """Something that a user or a policy may do."""
        rng, kind = self.rng, self.rng.integers(6)
        point = self.points[rng.integers(2)]
        if kind == 0:
            point.set_target(self.robot.position("world") + rng.uniform(-3.0, 3.0, 3))
        elif kind == 1:
            self.reorder()
        elif kind == 2:
            i = int(rng.integers(self.robot.size))
            low, high, q = self.lower[i], self.upper[i], self.robot.configuration[i]
            room = 2.0 * self.velocity()[i] ** 2 / self.acceleration + ROOM
            if low < q - room and q + room < high and np.isfinite(high - low):
                a, b = rng.uniform(low, q - room), rng.uniform(q + room, high)
                self.limits.set_range(self.robot.coordinate_names[i], a, b)
        elif kind == 3:
            self.limits.reset_ranges()
        elif kind == 4:
            most = 0.2 / self.dt if self.by_velocity else 4.0
            point.set_gain(float(rng.uniform(0.1, most)))
        elif rng.random() < 0.5:
            self.bad = 10
        else:
            try:
                point.set_target(np.array([0.0, rng.choice([np.nan, np.inf, 1e30]), 0.0]))
                worst.counts["accepted as a target"] += 1
            except hurcules.Error:
                worst.counts["refused"] += 1


def moved(robot: hurcules.Robot, model: mujoco.MjModel) -> list[str]:
    """Names of the bodies that its coordinates move."""
    frames = [model.body(i).name for i in range(1, model.nbody)]
    return [f for f in frames if f and robot.size and np.any(robot.position_jacobian(f))]


def found() -> list[mujoco.MjModel]:
    """Both forms of Hurcules, then the robots of other packages."""
    models = [hurcules.models.load(name) for name in hurcules.models.names()]
    for package, path in places():
        try:
            models.append(load(f"{package}/{path.stem}", path).model)
        except Exception:  # a part of a model, say
            continue
    return [model for model in models if moved(hurcules.Robot(model), model)]


def run(models: list[mujoco.MjModel], ticks: int, seed: int) -> Worst:
    """Episodes with robots at random."""
    worst, rng = Worst(), np.random.default_rng(seed)
    every = [(robot := hurcules.Robot(model), moved(robot, model)) for model in models]
    for _ in range(ticks // EPISODE):
        robot, frames = every[rng.integers(len(every))]
        robot.set_keyframe("")
        robot.set_velocity(np.zeros(robot.size))
        limits = hurcules.JointLimits("inside", robot)
        inside = np.minimum(0.01, 0.4 * (limits.upper - limits.lower))
        start = np.clip(robot.configuration, limits.lower + inside, limits.upper - inside)
        robot.set_configuration(start)
        episode = Episode(robot, frames, rng)
        for _ in range(EPISODE):
            before = episode.velocity()
            try:
                if rng.random() < EVENT:
                    episode.event(worst)
                episode.controller.step(robot)
            except hurcules.Error as error:
                worst.counts[f"exception: {error}"] += 1
                continue
            worst.look(episode, before)
    return worst


def main() -> None:
    """Prints what was counted."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ticks", type=int, default=200_000)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    warnings.simplefilter("ignore")
    every = found()
    worst = run(every, arguments.ticks, arguments.seed)
    print(f"{len(every)} robots; beyond the limits: position {worst.position:.1e} rad or m, ")
    print(f"velocity {worst.velocity:.1e}, change of velocity {worst.change:.1e} a tick")
    for what, count in worst.counts.items():
        print(f"{what}: {count}")


if __name__ == "__main__":
    main()
