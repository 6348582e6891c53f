"""Any robot, all by default: a table of the robots that installed packages ship.

Run:  python benchmarks/robots.py [--way 0.3] [--seeds 2] [--dt 0.005] [--only panda] [--out FILE]

For each model: does it load; its coordinates, and the joints that are left out; then the stack
`limits < hand < posture` for 5 s, all else by default, from the first posture to the hand of a
random posture inside the limits (`--way`: that share of the way to it). With six coordinates or
more the hand is led in 6-D, else its position. Worst of the seeds: the error, the speed at the end,
how far any limit of position, speed or acceleration was passed; the least time of a tick, of this
thread; where it misses, what any row of its targets [m or rad] lacks after 30 s of the same with a
`hurcules.Detour`. Packages: see arms.py, none of them needed; none is installed.
"""

from __future__ import annotations

import argparse
import time
import warnings
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from arms import Arm, load, name_of, places
from arrival import posture

import hurcules
from hurcules import JointLimits, OrientationTask, PositionTask, PostureTask, Stack, StackLevel

SECONDS = 5.0
MISS, TURN, MOVES = 1.0, 0.1, 0.01  # [mm], [degrees], [rad/s] or [m/s]


@dataclass
class Row:
    """What a robot did, the worst of all seeds."""

    name: str
    state: str = "loads"
    kept: int = 0
    left_out: int = 0
    spatial: bool = False  # led in 6-D
    millimetres: float = 0.0
    degrees: float = 0.0
    speed: float = 0.0  # [rad/s] or [m/s] in the last tenth of a second
    excess: float = 0.0  # [rad], [rad/s] or [rad/s^2] dt over any limit
    tick: float = field(default=np.inf)  # [s]
    exists: bool = True  # a posture for each target, says inverse_kinematics
    detour: float = 0.0  # [m] or [rad] that a row of the targets lacks where a `Detour` looked on

    @property
    def arrives(self) -> bool:
        """Within a millimetre and a tenth of a degree."""
        return self.state == "loads" and self.millimetres < MISS and self.degrees < TURN

    def text(self) -> str:
        """A line of Markdown."""
        if self.state != "loads":
            return f"| {self.name} | {self.state} | | | | | | | |"
        turn = f"{self.degrees:.2f}" if self.spatial else ""
        joints = f"{self.kept} / {self.left_out}"
        detour = "" if self.arrives else f"{self.detour:.1g}"
        return (
            f"| {self.name} | yes | {joints} | {self.millimetres:.2f} | {turn} "
            f"| {self.speed:.3f} | {self.excess:.0e} | {1e6 * self.tick:.0f} | {detour} |"
        )


def angle(a: np.ndarray, b: np.ndarray) -> float:
    """[degrees] between two rotations."""
    return float(np.degrees(np.arccos(np.clip((np.trace(a.T @ b) - 1) / 2, -1.0, 1.0))))


def reach(row: Row, robot: hurcules.Robot, hand: str, target: np.ndarray, dt: float) -> None:
    """Leads the hand for five seconds to where it is at this posture (n,)."""
    start = robot.configuration
    robot.set_configuration(target)
    place, turn = robot.position(hand), robot.orientation(hand)
    robot.set_configuration(start)
    limits, goal = JointLimits("limits", robot), PositionTask("hand", robot, hand)
    goal.set_target(place)
    level: list[hurcules.Task] = [goal]
    if row.spatial:
        level.append(OrientationTask("turn", robot, hand))
        level[1].set_target(turn)
    options = hurcules.VelocityControllerOptions(dt=dt)
    controller = hurcules.VelocityController(robot, options)
    stack = [limits, StackLevel("hand", level), PostureTask("posture", robot)]
    controller.set_stack(Stack(stack))
    before, most = np.zeros(robot.size), options.max_acceleration * dt
    ticks = round(SECONDS / dt)
    for tick in range(ticks):
        begin = time.thread_time()
        q = controller.step(robot)
        row.tick = min(row.tick, time.thread_time() - begin)
        now = controller.velocity
        over = [q - limits.upper, limits.lower - q, np.abs(now) - limits.max_velocity]
        over.append(np.abs(now - before) - most)
        row.excess = max(row.excess, *(float(part.max()) for part in over))
        if tick >= ticks - round(0.1 / dt):
            row.speed = max(row.speed, float(np.abs(now).max()))
        before = now
    robot.set_configuration(start)
    row.exists = row.exists and hurcules.inverse_kinematics(robot, [level]).reached
    robot.set_configuration(q)
    miss = 1e3 * float(np.linalg.norm(robot.position(hand) - place))
    turned = angle(robot.orientation(hand), turn) if row.spatial else 0.0
    row.millimetres, row.degrees = max(row.millimetres, miss), max(row.degrees, turned)
    if miss > MISS or turned > TURN:
        robot.set_configuration(start)
        row.detour = max(row.detour, by_detour(robot, limits, level, dt))


def by_detour(robot: hurcules.Robot, limits: JointLimits, level: list, dt: float) -> float:
    """[m or rad] that a row lacks after 30 s of the same with a `Detour`."""
    detour = hurcules.Detour(robot, [limits], [StackLevel("hand", level)])
    controller = hurcules.VelocityController(robot, hurcules.VelocityControllerOptions(dt=dt))
    controller.set_stack(detour.stacks["direct"])
    for _ in range(round(30.0 / dt)):
        controller.step(robot)
        detour.look(controller)
    for task in level:
        task.update(robot)
    return max(float(np.abs(task.error).max()) for task in level)


def examine(name: str, path: Path, options: argparse.Namespace) -> Row:
    """The row of one model."""
    row = Row(name)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            arm = load(name, path)
        except Exception as error:
            row.state = str(error).splitlines()[0][:60].replace("|", " ")
            return row
        if hurcules.Robot(arm.model).size == 0:
            row.state = "has no hinge or slide joint"
            return row
        return lead(row, arm, options)


def lead(row: Row, arm: Arm, options: argparse.Namespace) -> Row:
    """All seeds of one model."""
    robot, hand = arm.robot(), arm.hand
    row.kept = robot.size
    moved = {joint.joint for c in robot.coordinates for joint in c.joints}
    row.left_out = arm.model.njnt - len(moved)
    if not hand:
        row.state = "no frame that two coordinates move"
        return row
    row.spatial = robot.size >= 6
    for seed in range(options.seeds):
        robot = arm.robot()
        reach(row, robot, hand, posture(robot, seed, options.way), options.dt)
    return row


def main() -> None:
    """Prints the table and what it comes to."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dt", type=float, default=0.005, help="[s]")
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--way", type=float, default=0.3)
    parser.add_argument("--only", default="", help="part of a name")
    parser.add_argument("--out", type=Path, help="a file for the table")
    options = parser.parse_args()
    rows = []
    for package, path in places():
        name = name_of(package, path)
        if options.only in name:
            rows.append(examine(name, path, options))
            print(rows[-1].text(), flush=True)
    titles = (
        "robot",
        "loads",
        "joints kept / left out",
        "error [mm]",
        "[degrees]",
        "speed at the end",
        "over a limit",
        "tick [us]",
        "by a detour",
    )
    lines = ["| " + " | ".join(titles) + " |", "|---" * 9 + "|", *(row.text() for row in rows)]
    if options.out:
        options.out.write_text("\n".join(lines) + "\n")
    led = [row for row in rows if row.state == "loads"]
    print(
        f"{len(rows)} models, {len(led)} led: {sum(row.arrives for row in led)} arrive, "
        f"{sum(row.speed < MOVES for row in led)} rest, inverse_kinematics finds "
        f"{sum(row.exists for row in led)}, with a detour "
        f"{sum(row.arrives or row.detour < 1e-4 for row in led)} arrive; worst excess "
        f"{max((row.excess for row in led), default=0.0):.1e}"
    )


if __name__ == "__main__":
    main()
