"""The benchmarks still run, on a handful of problems, and tell the truth about what is not a time.

Not tested: any time. What they measure is for a person to compare (benchmarks/README.md).
"""

import json
import subprocess
import sys
from pathlib import Path


def run(*command: str | Path) -> str:
    """Standard output of a command that must succeed and must not complain."""
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    return done.stdout


def test_the_solver_neither_allocates_nor_gives_up_in_the_benchmark(build: Path) -> None:
    program = build / "benchmarks" / "solver_benchmark"
    text = run(program, "--json", "--problems", "2", "--ticks", "10", "--rounds", "1")
    records = [json.loads(line) for line in text.splitlines()]
    # 2 shapes x 2 rho x 4 sets, growth over 8 sizes and over 7 numbers of levels with 2 sets each
    assert len(records) == 16 + 16 + 14
    assert [r["allocations"] for r in records] == [0] * len(records)
    assert [r["unsolved"] for r in records] == [0] * len(records)
    assert all(r["cold_us"]["median"] > 0.0 for r in records)


def test_two_runs_can_be_compared(build: Path, root: Path, tmp_path: Path) -> None:
    program = build / "benchmarks" / "solver_benchmark"
    run_file = tmp_path / "run.json"
    run_file.write_text(run(program, "--json", "--problems", "1", "--ticks", "2", "--rounds", "1"))
    text = run(sys.executable, root / "benchmarks" / "compare.py", run_file, run_file)
    rows = [line.split("│") for line in text.splitlines() if line.startswith("│")]
    assert len(rows) == 46
    assert all(row[5].strip() == "1.00" for row in rows)


def test_the_program_that_callgrind_runs_solves_every_set(build: Path) -> None:
    for chosen in "0123":
        for warm in "012":
            run(build / "benchmarks" / "solver_instructions", "19", chosen, "0.1", warm, "1")


def test_table_4_2_has_a_figure_for_each_number_of_levels(build: Path) -> None:
    lines = run(build / "benchmarks" / "solver_table_4_2", "--solves", "70").splitlines()
    assert lines[0].split()[-7:] == list("2345678")
    ours = next(line for line in lines if line.startswith("lexicographic, median"))
    assert all(float(figure) > 0.0 for figure in ours.split()[-7:])


def test_our_answers_are_the_exact_ones_among_the_peers(root: Path) -> None:
    text = run(
        sys.executable, root / "benchmarks" / "solver_peers.py", "--problems", "3", "--rounds", "1"
    )
    rows = [line.split("│") for line in text.splitlines() if "hurcules " in line]
    rows = [row for row in rows if row[2].strip() == "hurcules"]
    assert len(rows) == 4
    # the column "off": violation of a level other than the oracle's
    assert [row[5].strip() for row in rows] == ["0"] * 4


def test_no_answer_is_missing_on_a_path(root: Path) -> None:
    program = root / "benchmarks" / "continuity.py"
    text = run(sys.executable, program, "--paths", "1", "--length", "0.006")
    rows = [line.split("│") for line in text.splitlines() if "hurcules" in line]
    assert len(rows) >= 4 and all(row[-2].strip() == "0" for row in rows)


def test_a_batch_answers_like_a_loop(root: Path) -> None:
    program = root / "benchmarks" / "batch.py"
    text = run(sys.executable, program, "--problems", "20", "--rounds", "1")
    rows = [line.split("│") for line in text.splitlines() if line.startswith("│")]
    assert [row[-2].strip() for row in rows] == ["0"] * 4
