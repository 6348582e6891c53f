"""Lifts many persons: masses, places, headings, frictions; one line of JSON a run.

    python benchmarks/lift_sweep.py OUT.jsonl [--mission casualty] [--cells nominal,place,mass]
                                    [--seeds 1] [--first 1000] [--workers 2]

Each run is the mission `lift`, `casualty` or `crossing` in the physics, friction alone. A seed
moves the person by up to 1 cm and 17 mrad, and each of the robot's joints by up to 0.7 mrad; in
`crossing`, where `--terrain road --way 5 --rise 0.1` say what lies on the way, it draws the road
too. With `--cells drawn` it draws who lies where too: within 0.3 m and 0.3 rad, friction 0.4 to
0.9. `--cells map` is all of 540 cells in a drawn order, a seed of its own each: what there is where
it is cut off is a sample of them. Runs that OUT.jsonl already holds are left out, so that an
interrupted sweep goes on. `--show` prints the success map of a file, and what went wrong how often.
"""

from __future__ import annotations

import argparse
import itertools
import re
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from sweeps import append, held, side_by_side

import hurcules

VARIATION = 1 / 3  # of 3 cm, 50 mrad, 2 mrad
FIRST_SEED, FIRST_DRAWN, FIRST_MAPPED = 1000, 4000, 20000
HEAD = 98.1  # [m/s^2] 10 g
MOST_VALUES = 8  # of a setting that are told one by one
NOMINAL = {
    "mass": 75,
    "offset": (0.0, 0.0),
    "yaw": 0.0,
    "friction": 0.45,
    "pose": "back",
    "arms": "sides",
}
Cell = dict[str, Any]


def cells(kind: str) -> Iterator[Cell]:
    """The settings of a part of the sweep."""
    changes: dict[str, list[Cell]] = {
        "nominal": [{}],
        "mass": [{"mass": mass} for mass in (50, 90, 120)],
        "friction": [{"friction": mu} for mu in (0.4, 0.6, 0.9)],
        "place": [
            {"offset": (dx, dy), "yaw": yaw}
            for dx, dy, yaw in (
                (0.10, 0.0, 0.0),
                (-0.10, 0.0, 0.0),
                (0.0, 0.15, 0.0),
                (0.0, -0.15, 0.0),
                (0.0, 0.0, 0.26),
                (0.0, 0.0, -0.26),
            )
        ],
        "turned": [{"yaw": 0.30}, {"yaw": -0.30}],
        "corner": [
            {"offset": (dx, dy), "yaw": yaw}
            for dx in (-0.10, 0.10)
            for dy in (-0.15, 0.15)
            for yaw in (-0.26, 0.26)
        ],
        "heavy": [
            {"mass": 120, "offset": (0.0, dy), "yaw": yaw}
            for dy, yaw in ((0.15, 0.0), (-0.15, 0.0), (0.0, 0.26), (0.0, -0.26))
        ],
        "light": [
            {"mass": 50, "offset": (0.0, dy), "yaw": yaw}
            for dy, yaw in ((0.15, 0.0), (-0.15, 0.0), (0.0, 0.26), (0.0, -0.26))
        ],
        "pose": [{"pose": pose} for pose in ("left", "front", "right")],
        "arms": [{"arms": arms} for arms in ("out", "folded")],
    }
    if kind not in changes:
        raise SystemExit(f"no cells '{kind}'; there are: {', '.join(changes)}")
    for change in changes[kind]:
        yield NOMINAL | change


def drawn(seed: int) -> Cell:
    """Anybody on the back, anywhere within what the mission is to take."""
    rng = np.random.default_rng(seed)
    x, y = rng.uniform(-0.30, 0.30, 2)
    return NOMINAL | {
        "offset": (round(float(x), 3), round(float(y), 3)),
        "yaw": round(float(rng.uniform(-0.3, 0.3)), 3),
        "mass": int(rng.choice([50, 75, 90, 120])),
        "friction": round(float(rng.uniform(0.4, 0.9)), 2),
    }


def mapped() -> list[Cell]:
    """Who lies where on the back, all 540, in a drawn order."""
    all_cells = itertools.product(
        (50, 75, 90, 120),
        (-0.10, -0.05, 0.0, 0.05, 0.10),
        (-0.15, 0.0, 0.15),
        (-0.26, 0.0, 0.26),
        (0.4, 0.6, 0.9),
    )
    made = [
        NOMINAL | {"mass": mass, "offset": (x, y), "yaw": yaw, "friction": mu}
        for mass, x, y, yaw, mu in all_cells
    ]
    return [made[i] for i in np.random.default_rng(0).permutation(len(made))]


def settings(kind: str, seeds: int, first: int | None) -> Iterator[tuple[Cell, int]]:
    """The settings of a part of the sweep, each with its seeds."""
    if kind == "drawn":
        begin = FIRST_DRAWN if first is None else first
        yield from ((drawn(seed), seed) for seed in range(begin, begin + seeds))
    elif kind == "map":
        begin = FIRST_MAPPED if first is None else first
        yield from ((cell, begin + i) for i, cell in enumerate(mapped()))
    else:
        begin = FIRST_SEED if first is None else first
        yield from ((cell, begin + seed) for cell in cells(kind) for seed in range(seeds))


def lift(task: tuple[str, Cell, int]) -> dict[str, Any]:
    """One run: how it ended, its figures, and the largest of some quantities in each phase.

    `torque_share` of a motor's peak torque, `face_N` [N] by which the robot presses the face,
    `head_mps2` [m/s^2] with gravity.
    """
    mission, cell, seed = task
    simulation = hurcules.Simulation(
        mission, seed, variation=VARIATION, record=False, parameters=cell
    )
    model, controller = simulation.model, simulation.controller
    joints = [model.joint(name).id for name in controller.joints]
    motors = [model.actuator_trnid[: model.nu, 0].tolist().index(joint) for joint in joints]
    peak = model.actuator_forcerange[motors, 1]
    seen = hurcules.Quantities(simulation, ["casualty/force/face", "casualty/head_mps2"])
    share, face, head = (defaultdict[str, float](float) for _ in range(3))
    while not simulation.finished:
        simulation.step()
        if simulation.question and simulation.phase == "settle":
            simulation.answer(True)  # to lift who does not lie on the back
        now = (np.max(np.abs(controller.torque) / peak), *simulation.read(seen))
        phase = simulation.phase
        for most, value in zip((share, face, head), now, strict=True):
            most[phase] = max(most[phase], float(value))
    return {
        **cell,
        "mission": mission,
        "seed": seed,
        "success": simulation.success,
        "reason": simulation.reason,
        "phase": simulation.phase,
        "seconds": simulation.time,
        "torque_share": dict(share),
        "face_N": dict(face),
        "head_mps2": dict(head),
        "figures": {name: float(value) for name, value in simulation.figures().items()},
    }


def key(run: dict[str, Any]) -> tuple[Any, ...]:
    """What tells runs apart."""
    return (run.get("mission", "lift"), *_place(run), run["seed"])


def _place(run: dict[str, Any]) -> tuple[Any, ...]:
    lies = run["pose"] if run.get("arms", "sides") == "sides" else f"{run['pose']}, {run['arms']}"
    return (run["mass"], *run["offset"], run["yaw"], run["friction"], lies, _terrain(run))


def _terrain(run: dict[str, Any]) -> str:
    return " ".join(str(run[name]) for name in ("terrain", "way", "rise") if name in run)


def _slid(figures: dict[str, float]) -> float:
    """[m] along the arms in the hold, or on the bed while driving home."""
    names = ("held_drift_m", "slid_ahead_m", "slid_aside_m")
    return max(figures[name] for name in names if name in figures)


def _largest(runs: list[dict[str, Any]], name: str) -> float:
    """Of the phases but the first, in which who lies on a side rolls over; nan if not noted."""
    return max(
        (value for run in runs for phase, value in run.get(name, {}).items() if phase != "settle"),
        default=float("nan"),
    )


def show(path: Path) -> None:
    """Prints the map: a line a cell with how many of how many, and why not."""
    runs = held(path)
    table = defaultdict(list)
    for run in runs:
        table[_place(run)].append(run)
    print(
        "mass  ahead  left   yaw    mu          pose   success  push  slid   torque "
        "contact  face  head  carried  failures"
    )
    for place, found in table.items():
        mass, dx, dy, yaw, mu, pose, terrain = place
        good = sum(run["success"] for run in found)
        push = max(run["figures"]["push_N"] for run in found)
        drift = max(_slid(run["figures"]) for run in found)
        torque = max(max(run["torque_share"].values()) for run in found)
        contact, carried = (
            max(run["figures"][name] for run in found) for name in ("contact_share", "support_N")
        )
        face, head = (_largest(found, name) for name in ("face_N", "head_mps2"))
        why = "; ".join(run["reason"] for run in found if not run["success"])
        print(
            f"{mass:4} {dx:+6.2f} {dy:+6.2f} {yaw:+6.2f} {mu:5.2f} {pose:>12} "
            f"{good:4}/{len(found):<3} {push:5.0f} {drift:6.3f} {torque:6.2f} "
            f"{contact:7.1f} {face:5.0f} {head:5.0f} {carried:8.0f}   {terrain} {why}"
        )
    for axis, name in enumerate(("mass", "ahead", "left", "yaw", "mu")):
        if len(shares := list(_shares(runs, axis))) <= MOST_VALUES:  # not where they were drawn
            print(f"{name:6}", ", ".join(shares))
    good = sum(run["success"] for run in runs)
    print(f"{good} of {len(runs)}")
    for name, limit in (("contact_share", 1.0), ("head_mps2", HEAD)):
        print(f"{name} over {limit:g}: {sum(run['figures'][name] > limit for run in runs)}")
    failures = Counter(_class(run["reason"]) for run in runs if not run["success"])
    for words, number in failures.most_common():
        print(f"{number} times {words}")


def _shares(runs: list[dict[str, Any]], axis: int) -> Iterator[str]:
    """How often it works at each value of one of the settings."""
    done = defaultdict(list)
    for run in runs:
        done[_place(run)[axis]].append(run["success"])
    for value in sorted(done):
        yield f"{value:g}: {sum(done[value])} of {len(done[value])}"


def _class(reason: str) -> str:
    """A reason without what was measured."""
    return re.sub(r"\b(is|at) (-?\d[\d.]*|nan)", r"\1 ...", reason)


def main() -> None:
    """Runs what is missing."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--mission", default="lift", choices=hurcules.lift.MISSIONS)
    parser.add_argument("--cells", default="nominal")
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--first", type=int)
    parser.add_argument("--terrain", default="road")
    parser.add_argument("--way", type=float, default=5.0)
    parser.add_argument("--rise", type=float, default=0.1)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--show", action="store_true")
    arguments = parser.parse_args()
    if arguments.show:
        return show(arguments.out)
    done = {key(run) for run in held(arguments.out)}
    ground = {name: getattr(arguments, name) for name in ("terrain", "way", "rise")}
    over = arguments.mission == "crossing"
    tasks = [
        (arguments.mission, cell, seed)
        for kind in arguments.cells.split(",")
        for cell, seed in settings(kind, arguments.seeds, arguments.first)
        for cell in [cell | {**ground, "ground": seed} if over else cell]
        if key(cell | {"mission": arguments.mission, "seed": seed}) not in done
    ]
    append(
        arguments.out,
        side_by_side(lift, tasks, arguments.workers),
        lambda run: (key(run), run["success"], run["reason"]),
    )


if __name__ == "__main__":
    main()
