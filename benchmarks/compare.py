"""Two runs of solver_benchmark --json beside each other: new / old, of times over the bare chain.

build/make/benchmarks/solver_benchmark --json > old.json      (of the old commit, and again)
python benchmarks/compare.py old.json new.json
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from rich.console import Console
from rich.table import Table

TIMES = ("cold", "warm", "jump", "tick")


def read(path: Path) -> dict[tuple, dict]:
    """The records of a run by what they measured."""
    records = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    return {(r["unknowns"], tuple(r["rows"]), r["rho"], r["set"]): r for r in records}


def share(record: dict, what: str) -> float:
    """Median time over that of the bare chain."""
    return float(record[f"{what}_us"]["median"] / record["chain_us"]["median"])


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    given = parser.parse_args()
    old, new = read(given.old), read(given.new)
    table = Table("n", "levels", "rho", "set", *TIMES, "changes", title="new / old")
    for key, record in new.items():
        if key not in old:
            continue
        ratios = [
            share(record, what) / share(old[key], what) if share(old[key], what) else float("nan")
            for what in TIMES
        ]
        changes = f"{old[key]['changes']:.1f} -> {record['changes']:.1f}"
        unknowns, rows, rho, name = key
        what = map(str, (unknowns, len(rows), rho, name))
        table.add_row(*what, *(f"{ratio:.2f}" for ratio in ratios), changes)
    Console(width=100).print(table)


if __name__ == "__main__":
    main()
