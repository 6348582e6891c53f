"""Inverse kinematics of a two-handed humanoid: Hurcules beside mink, pink, placo and roboplan.

Same robot, targets and limits for all (problem.py), each peer in a virtual environment of its own
under build/, made on the first call. Peers run in turn, several rounds; a time is that of the best
round, a ratio one of medians of that round.

    python benchmarks/inverse_kinematics/run.py [--peers mink placo] [--rounds 3] [--json FILE]
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import venv
from dataclasses import dataclass, field
from pathlib import Path

import mujoco
import numpy as np
from hurcules_peer import with_hands
from problem import DT, HANDS, SCENARIOS, Joint, robot_description
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

HERE = Path(__file__).parent
FOLDER = HERE.parents[1] / "build" / "ik_peers"
DATA = "example-robot-data==6.0.0"


@dataclass(frozen=True)
class Entry:
    """One line of the table."""

    peer: str
    packages: tuple[str, ...]
    option: dict[str, object] = field(default_factory=dict)


MINK = ("mink==1.3.0", f"mujoco=={mujoco.__version__}", "daqp==0.11.0", DATA)
PINK = ("pin-pink==4.4.0", "pin==4.1.0", "daqp==0.11.0", DATA)
PLACO = ("placo==0.10.2", "example-robot-data==5.0.0")
ROBOPLAN = ("roboplan[all]==0.7.0", DATA)
ENTRIES = [
    *(Entry("hurcules", (DATA,), {"levels": levels}) for levels in (4, 5, 6, 7)),
    *(Entry("placo", PLACO, {"right_weight": weight}) for weight in (1.0, 100.0)),
    *(Entry("roboplan", ROBOPLAN, {"priorities": wanted}) for wanted in (False, True)),
    *(Entry("mink", MINK, {"right_weight": weight}) for weight in (1.0, 100.0)),
    *(Entry("pink", PINK, {"right_weight": weight}) for weight in (1.0, 100.0)),
]


def main() -> None:
    """Runs what the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    names = sorted({entry.peer for entry in ENTRIES})
    parser.add_argument("--peers", nargs="+", choices=names, default=names)
    parser.add_argument("--scenarios", nargs="+", choices=SCENARIOS, default=list(SCENARIOS))
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--ticks", type=int, default=1600)
    parser.add_argument("--json", type=Path, help="also write the figures here")
    arguments = parser.parse_args()
    entries = [entry for entry in ENTRIES if entry.peer in (*arguments.peers, "hurcules")]
    console = Console(width=150)
    with console.status("making the peers' environments"):
        for entry in entries:
            _interpreter(entry)
    judge, figures = Judge(), {}
    with Progress(console=console) as progress:
        steps = len(arguments.scenarios) * len(entries) * arguments.rounds
        bar = progress.add_task("running", total=steps)
        for scenario in arguments.scenarios:
            best: dict[str, dict[str, object]] = {}
            for _ in range(arguments.rounds):
                for entry in entries:
                    run = judge.figures(_run(entry, scenario, arguments.ticks))
                    old = best.setdefault(run["name"], run)
                    if run["median_us"] < old["median_us"]:
                        best[run["name"]] = run
                    progress.advance(bar)
            figures[scenario] = list(best.values())
    for scenario, rows in figures.items():
        console.print(_table(scenario, rows))
    if arguments.json:
        arguments.json.write_text(json.dumps(figures, indent=2))


class Judge:
    """Measures every peer's joint angles with one and the same model."""

    def __init__(self) -> None:
        urdf, self.joints = robot_description()
        self.model = mujoco.MjModel.from_xml_string(with_hands(urdf))
        self.data = mujoco.MjData(self.model)

    def figures(self, run: dict[str, object]) -> dict[str, object]:
        """Sums up what a worker printed."""
        times, q = np.array(run["microseconds"]), np.array(run["q"])
        speed = np.diff(q, axis=0) / DT
        row = {
            "name": run["name"],
            "median_us": float(np.median(times)),
            "p99_over_median": float(np.percentile(times, 99) / np.median(times)),
            "failed": run["failed"],
            "position_excess": _excess(q, self.joints, "position"),
            "speed_excess": _excess(speed, self.joints, "speed"),
            "acceleration": float(np.abs(np.diff(speed, axis=0)).max() / DT),
        }
        self.data.qpos[:] = q[-1]
        mujoco.mj_kinematics(self.model, self.data)
        for hand, side in zip(HANDS, ("right", "left"), strict=True):
            rotation, place = (np.array(part) for part in run["aim"][hand])
            body = self.data.body(hand)
            row[f"{side}_mm"] = 1e3 * float(np.linalg.norm(body.xpos - place))
            cosine = (np.trace(rotation.T @ body.xmat.reshape(3, 3)) - 1) / 2
            row[f"{side}_deg"] = float(np.degrees(np.arccos(np.clip(cosine, -1, 1))))
        return row


def _excess(values: np.ndarray, joints: list[Joint], what: str) -> float:
    """By how much a limit is passed at most [rad, m, or these per second]; 0 for not at all."""
    lower = np.array([-j.speed if what == "speed" else j.lower for j in joints])
    upper = np.array([j.speed if what == "speed" else j.upper for j in joints])
    return max(0.0, float(np.maximum(lower - values, values - upper).max()))


def _interpreter(entry: Entry) -> Path:
    """The Python of a peer's environment, which is made when it is not there."""
    if entry.peer == "hurcules":
        _install(Path(sys.executable), entry.packages)
        return Path(sys.executable)
    folder = FOLDER / entry.peer
    python, ready = folder / "bin" / "python", folder / "ready"
    if not ready.exists():
        venv.create(folder, with_pip=True, clear=True)
        _install(python, entry.packages)
        ready.touch()
    return python


def _install(python: Path, packages: tuple[str, ...]) -> None:
    subprocess.run([python, "-m", "pip", "install", "--quiet", *packages], check=True)


def _run(entry: Entry, scenario: str, ticks: int) -> dict[str, object]:
    command = [_interpreter(entry), HERE / "worker.py", entry.peer, scenario]
    options = ["--ticks", str(ticks), "--option", json.dumps(entry.option)]
    # what a library says on its way goes before the last line
    done = subprocess.run([*command, *options], check=True, capture_output=True, text=True)
    return json.loads(done.stdout.splitlines()[-1])


def _table(scenario: str, rows: list[dict[str, object]]) -> Table:
    table = Table(title=f"{scenario}: {SCENARIOS[scenario]}", title_justify="left", box=None)
    for head in ("", "µs", "p99/med", "x placo", "right mm", "deg", "left mm", "deg"):
        table.add_column(head, justify="left" if not head else "right")
    for head in ("failed", "over position", "over speed", "max rad/s²"):
        table.add_column(head, justify="right")
    placo = next((row["median_us"] for row in rows if row["name"] == "placo"), float("nan"))
    for row in rows:
        table.add_row(
            str(row["name"]),
            f"{row['median_us']:.1f}",
            f"{row['p99_over_median']:.1f}",
            f"{row['median_us'] / placo:.2f}",
            *(f"{row[key]:.2f}" for key in ("right_mm", "right_deg", "left_mm", "left_deg")),
            str(row["failed"]),
            f"{row['position_excess']:.1e}",
            f"{row['speed_excess']:.1e}",
            f"{row['acceleration']:.0f}",
        )
    return table


if __name__ == "__main__":
    main()
