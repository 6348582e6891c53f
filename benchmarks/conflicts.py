"""Two hands, one out of reach: how near does the far one come, beside the nearest that there is?

Run:  python benchmarks/conflicts.py [--dt 0.005 0.001] [--seeds 10] [--only baxter] [--law thesis]
                                     [--detour] [--seconds 25] [--out FILE.json]

The stack is `limits < first hand < second hand < centre of mass < posture`, both hands in 6-D, all
else by default. The first hand's pose is that of a posture half the way to a random one, the second
one's lies 1.5 m beyond that in a random direction. After 25 s (`--seconds`): error of the first
hand, of the second, and the speed of the last 2 s. Beside them the least error of the second level
(metres and radians, squares added, as the level adds them) that keeps the first hand's pose and the
limits, by SLSQP of SciPy from where the runs end, the posture of the targets, and three random
ones: an upper bound of what is possible. And the least within 0.1 rad of where a run ends: where
that is no less, the run has come to a minimum, not to a stop. Both in thousandths, which are mm
where only places lack; counted are the runs whose first hand arrives. Robots: that of this
repository and, where they are installed, those of robosuite and example-robot-data. `--detour`: a
`hurcules.Detour` looks on for both hands.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from arms import Arm, arms
from arrival import follow, posture

import hurcules
from hurcules import (
    CenterOfMassTask,
    Detour,
    JointLimits,
    OrientationTask,
    PositionTask,
    PostureTask,
    Stack,
    StackLevel,
)

HANDS = {
    "hurcules/manipulation": ("R_tcp", "L_tcp"),
    "robosuite/baxter": ("right_hand", "left_hand"),
    "example_robot_data/g1_29dof_rev_1_0": ("right_rubber_hand", "left_rubber_hand"),
    "example_robot_data/simple_humanoid": ("r_wrist", "l_wrist"),
    "example_robot_data/talos_reduced": (
        "gripper_right_motor_double_link",
        "gripper_left_motor_double_link",
    ),
}
OUT_OF_REACH = 1.5  # [m]
SECONDS = 25.0
MISS, TURN, MOVES = 1.0, 0.1, 0.01  # [mm], [degrees], [rad/s]
STARTS, ITERATIONS, KEPT = 3, 80, 1e-5  # of the search; error of the first hand [m, rad]
WIDE = 6.0  # [rad] or [m], where a coordinate has no limit
NEAR_BY = 0.1  # [rad] or [m] a coordinate

Error = tuple[np.ndarray, np.ndarray]  # e (6,) [m, rad] of a hand, de/dq (6, n)


class Ours(Arm):
    """The robot of this repository, on its tracks."""

    def robot(self) -> hurcules.Robot:
        """See Arm."""
        robot = hurcules.Robot(self.model)
        robot.set_keyframe("ready")
        robot.stand_on("lower_leg_L")
        return robot


class Conflict:
    """A robot with two hands and where they shall be.

    Args:
        arm: one of HANDS.
        seed: of the targets.
    """

    def __init__(self, arm: Arm, seed: int) -> None:
        self.robot, names = arm.robot(), HANDS[arm.name]
        self.start = self.robot.configuration
        self.inside = posture(self.robot, seed, 0.5)
        self.robot.set_configuration(self.inside)
        places = [(self.robot.position(n).copy(), self.robot.orientation(n)) for n in names]
        out = np.random.default_rng(1000 + seed).normal(size=3)
        places[1][0][:] += OUT_OF_REACH * out / np.linalg.norm(out)
        self.limits, self.hands = JointLimits("limits", self.robot), []
        for name, (place, turn) in zip(names, places, strict=True):
            position = PositionTask(name + " place", self.robot, name)
            orientation = OrientationTask(name + " turn", self.robot, name)
            position.set_target(place)
            orientation.set_target(turn)
            self.hands.append((position, orientation))

    def run(
        self, law: str, dt: float, round_about: bool = False, seconds: float = SECONDS
    ) -> dict[str, float]:
        """Follows the stack from the first posture on, by another posture where that is wanted."""
        self.robot.set_configuration(self.start)
        levels = [StackLevel(f"hand {i}", list(hand)) for i, hand in enumerate(self.hands)]
        below = [CenterOfMassTask("com", self.robot), PostureTask("posture", self.robot)]
        stack, detour = Stack([self.limits, *levels, *below]), None
        if round_about:
            detour = Detour(self.robot, [self.limits], levels, below)
            stack = detour.stacks["direct"]
        motion = follow(self.robot, stack, self.limits, law, dt, seconds, detour)
        row = {"speed": motion.fastest, "change": motion.hardest, "excess": motion.excess}
        errors = self.errors(self.robot.configuration)
        for name, (e, _) in zip(("near", "far"), errors, strict=True):
            row[f"{name}_mm"] = 1e3 * float(np.linalg.norm(e[:3]))
            row[f"{name}_deg"] = float(np.degrees(np.linalg.norm(e[3:])))
            row[f"{name}_error"] = float(np.linalg.norm(e))
        return row

    def errors(self, q: np.ndarray) -> list[Error]:
        """Of both hands at a posture (n,)."""
        self.robot.set_configuration(q)
        both = []
        for hand in self.hands:
            for task in hand:
                task.update(self.robot)
            e = np.concatenate([task.error for task in hand])
            both.append((e, np.vstack([task.jacobian for task in hand])))
        return both

    def best(self, starts: list[np.ndarray], room: float = np.inf) -> np.ndarray | None:
        """The least error of the second hand that was found, (6,), so far from a start at most."""
        from scipy.optimize import minimize  # not needed by the tests: pip install scipy

        last: tuple[np.ndarray, list[Error]] = (np.full(self.robot.size, np.nan), [])

        def at(q: np.ndarray, hand: int) -> Error:
            nonlocal last
            if not np.array_equal(q, last[0]):
                last = q.copy(), self.errors(q)
            return last[1][hand]

        def far(q: np.ndarray) -> tuple[float, np.ndarray]:
            e, J = at(q, 1)
            return float(e @ e), 2.0 * J.T @ e

        keep = {"type": "eq", "fun": lambda q: at(q, 0)[0], "jac": lambda q: at(q, 0)[1]}
        best = None
        for given in starts:
            lower = np.maximum(self.limits.lower, -WIDE)
            upper = np.minimum(self.limits.upper, WIDE)
            start = np.clip(given, lower, upper)
            lower, upper = np.maximum(lower, start - room), np.minimum(upper, start + room)
            found = minimize(
                far,
                start,
                jac=True,
                method="SLSQP",
                bounds=list(zip(lower, upper, strict=True)),
                constraints=keep,
                options={"maxiter": ITERATIONS, "ftol": 1e-10},
            )
            for q in (
                start,
                np.clip(found.x, lower, upper),
            ):  # a search may end worse than it began
                near, e = at(q, 0)[0], at(q, 1)[0]
                if np.abs(near).max() < KEPT and (best is None or e @ e < best @ best):
                    best = e.copy()
        return best


def subjects(wanted: str) -> Iterator[Arm]:
    """The robots of HANDS that are there."""
    if wanted in "hurcules/manipulation":
        yield Ours("hurcules/manipulation", hurcules.models.load("manipulation"), "R_tcp")
    for name in HANDS:
        if wanted in name:
            yield from (arm for arm in arms(name) if arm.name == name)


def differ(q: np.ndarray, other: np.ndarray | None) -> bool:
    """Whether two starts may lead to different ends."""
    return other is None or float(np.abs(q - other).max()) > 0.01


def examine(arm: Arm, seed: int, options: argparse.Namespace) -> list[dict[str, object]]:
    """A row for each control period."""
    conflict, rows, ends = Conflict(arm, seed), [], []
    for dt in options.dt:
        run = conflict.run(options.law, dt, options.detour, options.seconds)
        ends.append(conflict.robot.configuration)
        rows.append({"robot": arm.name, "seed": seed, "dt": dt, **run})
    inside = conflict.inside
    away = 0.5 * np.random.default_rng(seed).normal(size=(STARTS, len(inside)))
    apart = [q for q, before in zip(ends, [None, *ends[:-1]], strict=True) if differ(q, before)]
    best = conflict.best([*apart, inside, *(inside + away)])
    for row, end in zip(rows, ends, strict=True):
        for name, e in (("best", best), ("near_by", conflict.best([end], NEAR_BY))):
            if e is not None:
                row[f"{name}_mm"] = 1e3 * float(np.linalg.norm(e[:3]))
                row[f"{name}_deg"] = float(np.degrees(np.linalg.norm(e[3:])))
                row[f"{name}_error"] = float(np.linalg.norm(e))
    return rows


def line(name: str, dt: float, rows: list[dict[str, float]]) -> str:
    """What the conflicts of a robot come to, in Markdown."""
    there = [r for r in rows if r["near_mm"] < MISS and r["near_deg"] < TURN and "best_error" in r]
    missed = max(rows, key=lambda r: r["near_mm"])
    lacks = [1e3 * (r["far_error"] - r["best_error"]) for r in there]
    local = [1e3 * (r["far_error"] - r["near_by_error"]) for r in there]
    speeds = np.array([r["speed"] for r in rows])
    return (
        f"| {name} | {1e3 * dt:g} | {len(there)} of {len(rows)} | {missed['near_mm']:.1f}, "
        f"{missed['near_deg']:.2f} | {(np.array(lacks) < 10).sum()} of {len(lacks)} "
        f"| {np.median(lacks):.1f}, {max(lacks):.0f} | {np.median(local):.1f}, {max(local):.1f} "
        f"| {(speeds < MOVES).sum()} of {len(rows)}, {speeds.max():.3f} |"
    )


def main() -> None:
    """Prints each conflict, then the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--law", default="arrive", choices=["arrive", "thesis"])
    parser.add_argument("--detour", action="store_true")
    parser.add_argument("--dt", type=float, nargs="+", default=[0.005, 0.001], help="[s]")
    parser.add_argument("--seconds", type=float, default=SECONDS)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--only", default="", help="part of a name")
    parser.add_argument("--out", type=Path, help="a JSON file")
    options = parser.parse_args()
    rows: list[dict[str, object]] = []
    for arm in subjects(options.only):
        for seed in range(options.seeds):
            for row in examine(arm, seed, options):
                values = row.values()
                texts = (f"{v:.4g}" if isinstance(v, float) else str(v) for v in values)
                print(" ".join(texts), flush=True)
                rows.append(row)
            if options.out:  # after each, since it takes long
                options.out.write_text(json.dumps(rows, indent=1) + "\n")
    titles = ["robot", "dt [ms]", "first hand arrives", "its worst error [mm, degrees]"]
    titles += ["far hand within 10 of the best", "beyond it, median, worst"]
    titles += ["beyond the best within 0.1 rad", "rests, fastest [rad/s]"]
    print("| " + " | ".join(titles) + " |", "|---" * len(titles) + "|", sep="\n")
    for name in dict.fromkeys(row["robot"] for row in rows):
        for dt in options.dt:
            print(line(name, dt, [r for r in rows if r["robot"] == name and r["dt"] == dt]))


if __name__ == "__main__":
    main()
