"""The examples run as they stand, say something, and stay short."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = sorted((Path(__file__).parents[2] / "python" / "examples").glob("*.py"))


def test_they_are_numbered() -> None:
    assert len(EXAMPLES) >= 6
    assert [path.name[:3] for path in EXAMPLES] == [f"{i + 1:02}_" for i in range(len(EXAMPLES))]


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_it_runs_and_says_something(example: Path, tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-W", "error", example],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    assert len(done.stdout.splitlines()) >= 5
    assert "nan" not in done.stdout


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_it_is_short_and_says_at_its_top_what_it_is(example: Path) -> None:
    text = example.read_text(encoding="utf-8")
    assert len(text.splitlines()) < 60
    assert f"Run:  python python/examples/{example.name}" in (
        ast.get_docstring(ast.parse(text)) or ""
    )


def test_the_two_hand_reach_takes_twelve_lines() -> None:
    text = EXAMPLES[2].read_text(encoding="utf-8")
    block = text.partition("in twelve lines")[2].partition("\n\n")[0]
    lines = [line for line in block.splitlines()[1:] if line.strip()]
    assert 0 < len(lines) <= 12


def test_gradients_of_the_torch_example_are_right() -> None:
    pytest.importorskip("torch", reason="PyTorch is not installed; remedy: pip install torch")
    done = subprocess.run([sys.executable, EXAMPLES[6]], capture_output=True, text=True)
    lines = done.stdout.splitlines()
    assert lines[0] == "gradcheck True", done.stderr
    assert lines[-1].startswith("step 150") and float(lines[-1].split()[3]) < 1e-5
