"""Instructions of one solve, counted by callgrind: exact, so two commits can be compared.

Mean over the problems of a set; with one compiler and one library the counts repeat, whatever else
the machine does.

    python benchmarks/count_instructions.py [--program PATH] [--problems 20] [--json]
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
from itertools import chain, product
from pathlib import Path

from rich.console import Console
from rich.table import Table

ROOT = Path(__file__).parent.parent
PROGRAM = ROOT / "build" / "make" / "benchmarks" / "solver_instructions"
# warm: the same problem again; jump: its targets moved 0.3 s on at once
STARTS = ("cold", "warm", "jump")
SETS = ("no conflict", "box conflicts", "conflicting levels", "mixed levels")


def instructions(
    program: Path, unknowns: int, chosen: int, rho: float, start: str, problems: int
) -> int:
    """Instructions of one solve, mean over the problems."""
    command = [
        "valgrind",
        "--tool=callgrind",
        "--toggle-collect=measured_solve",
        "--callgrind-out-file=/dev/null",
        str(program),
        *map(str, (unknowns, chosen, rho, STARTS.index(start), problems)),
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    collected = re.search(r"Collected : (\d+)", done.stderr)
    if collected is None:
        raise RuntimeError(done.stderr)
    return int(collected[1]) // problems


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--program", type=Path, default=PROGRAM)
    parser.add_argument("--problems", type=int, default=20)
    parser.add_argument("--json", action="store_true")
    given = parser.parse_args()
    # one level of 97 rows in 88 unknowns: what rho = 0 costs where levels are large
    large = product((88,), (0.0,), STARTS[:2])
    counts = {
        f"n {n}, rho {rho}, {start}": [
            instructions(given.program, n, k, rho, start, given.problems) for k in range(len(SETS))
        ]
        for n, rho, start in chain(product((19, 38), (0.1, 0.0), STARTS), large)
    }
    if given.json:
        print(json.dumps({"sets": SETS, "instructions": counts}))
        return
    table = Table("instructions of a solve", *SETS)
    for case, row in counts.items():
        table.add_row(case, *(f"{count:,}" for count in row))
    Console().print(table)


if __name__ == "__main__":
    main()
