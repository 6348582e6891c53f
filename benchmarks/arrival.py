"""Does a hand arrive, on any robot, by default? A table of all robots that installed packages ship.

Run:  python benchmarks/arrival.py [--law thesis] [--dt 0.001] [--seeds 2] [--only panda]
      python benchmarks/arrival.py --straight 0.15 --only robosuite

The stack is `limits < hand < posture`, all else by default. The target is the hand of a random
posture inside the limits (`--way 0.3`: that share of the way to it), so that it can be reached,
though not always by a descent from where the robot stands: joint limits leave dead ends. `alone`
is the same without the posture: what the hand itself does. With `--straight`: from angles as near
0 as the limits allow, so far towards the sixth joint before the hand. Two hands: conflicts.py.

Packages, none of them needed: robosuite, gymnasium, gymnasium-robotics, dm_control, metaworld,
example-robot-data.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from arms import Arm, arms, ranges

import hurcules
from hurcules import (
    JointLimits,
    PositionTask,
    PostureTask,
    Stack,
    rhqp,
)

MISS, MOVES = 1e-3, 0.01  # [m], [rad/s]


@dataclass
class Motion:
    """How a stack was followed."""

    fastest: float = 0.0  # [rad/s] in the last two seconds
    hardest: float = 0.0  # largest change of velocity over the one that is allowed
    excess: float = 0.0  # [rad] or [m] over a limit


def follow(
    robot: hurcules.Robot,
    stack: Stack,
    limits: JointLimits,
    law: str,
    dt: float,
    seconds: float,
    detour: hurcules.Detour | None = None,
) -> Motion:
    """Runs a stack for so long from where the robot stands; a detour, if any, looks on."""
    solver = rhqp.SolverOptions(handover="smooth" if law == "thesis" else "strict")
    options = hurcules.VelocityControllerOptions(dt=dt, law=law, solver=solver)
    controller = hurcules.VelocityController(robot, options)
    controller.set_stack(stack)
    motion, last, ticks = Motion(), np.zeros(robot.size), round(seconds / dt)
    for tick in range(ticks):
        q = controller.step(robot)
        now = controller.velocity
        if detour:
            detour.look(controller)
        change = float(np.abs(now - last).max()) / (options.max_acceleration * dt)
        motion.hardest = max(motion.hardest, change)
        motion.excess = max(motion.excess, float((q - limits.upper).max()))
        motion.excess = max(motion.excess, float((limits.lower - q).max()))
        if tick >= ticks - round(2.0 / dt):
            motion.fastest = max(motion.fastest, float(np.abs(now).max()))
        last = now
    return motion


def posture(robot: hurcules.Robot, seed: int, way: float) -> np.ndarray:
    """This share of the way to a random posture, 5 % of the ranges kept free."""
    lower, upper = ranges(robot)
    share = 0.05 + 0.9 * np.random.default_rng(seed).random(robot.size)
    start = robot.configuration
    return start + way * (lower + share * (upper - lower) - start)


def place_inside(arm: Arm, robot: hurcules.Robot, way: float) -> np.ndarray:
    """Stretches the arm; where its hand is then, so far [m] towards the arm's foot."""
    lower, upper = ranges(robot)
    robot.set_configuration(np.clip(np.zeros(robot.size), lower, upper))
    foot = robot.coordinates[max(0, robot.size - 6)].joints[0].joint
    body = arm.model.body(int(arm.model.jnt_bodyid[arm.model.joint(foot).id])).name
    place = robot.position(arm.hand)
    line = robot.position(body) - place
    return place + way * line / np.linalg.norm(line)


def reach(arm: Arm, seed: int, options: argparse.Namespace, alone: bool) -> tuple[float, Motion]:
    """The miss [m] and how the hand came there."""
    robot = arm.robot()
    if options.straight:
        target = place_inside(arm, robot, options.straight)
    else:
        start = robot.configuration
        robot.set_configuration(posture(robot, seed, options.way))
        target = robot.position(arm.hand)
        robot.set_configuration(start)
    limits, hand = JointLimits("limits", robot), PositionTask("hand", robot, arm.hand)
    hand.set_target(target)
    levels = [limits, hand] if alone else [limits, hand, PostureTask("posture", robot)]
    motion = follow(robot, Stack(levels), limits, options.law, options.dt, options.seconds)
    return float(np.linalg.norm(robot.position(arm.hand) - target)), motion


def rows(options: argparse.Namespace) -> Iterator[tuple[str, list[float], Motion]]:
    """Name, misses [m] and motion of each run."""
    for arm in arms(options.only):
        for seed in range(options.seeds):
            name = f"{arm.name} {seed}"
            miss, motion = reach(arm, seed, options, alone=False)
            alone = reach(arm, seed, options, alone=True)[0] if miss > MISS else miss
            yield name, [miss, alone], motion


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--law", default="arrive", choices=["arrive", "thesis"])
    parser.add_argument("--dt", type=float, default=0.005, help="[s]")
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--way", type=float, default=1.0)
    parser.add_argument("--only", default="", help="part of a name")
    parser.add_argument("--straight", type=float, default=0.0, help="[m]")
    options = parser.parse_args()
    print(f"{'':52s}      miss     alone [mm]  rad/s at the end, change / allowed")
    count = missed = dead_ends = moving = 0
    hardest = excess = 0.0
    for name, misses, motion in rows(options):
        print(
            f"{name:52s} {1e3 * misses[0]:9.2f} {1e3 * misses[1]:9.2f}"
            f"       {motion.fastest:6.3f} {motion.hardest:6.3f}",
            flush=True,
        )
        count += 1
        missed += misses[0] > MISS
        dead_ends += misses[1] > MISS
        moving += motion.fastest > MOVES
        hardest, excess = max(hardest, motion.hardest), max(excess, motion.excess)
    print(
        f"{count} runs: {missed} miss by more than 1 mm ({dead_ends} alone too), {moving} move; "
        f"change of velocity {hardest:.3f} of the allowed, over a limit by {excess:.1e}"
    )


if __name__ == "__main__":
    main()
