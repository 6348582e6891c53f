"""Standard output that is gone, full, or has few letters: a run is done all the same.

Strategy: processes of their own, whose standard output is such a one from the start.
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from hurcules import extras

COMMAND = [sys.executable, "-m", "hurcules"]


def call_into(stdout: int, *words: str) -> tuple[int, str]:
    done = subprocess.run(
        [*COMMAND, *words], stdout=stdout, stderr=subprocess.PIPE, text=True, timeout=300
    )
    return done.returncode, done.stderr


def call_unread(*words: str) -> tuple[int, str]:
    """Exit code and complaint where nobody reads, as behind `| head`."""
    reader, writer = os.pipe()
    os.close(reader)
    try:
        return call_into(writer, *words)
    finally:
        os.close(writer)


def test_a_run_that_nobody_reads_writes_all_its_files(tmp_path: Path) -> None:
    asked = ["run", "stretch", "--seconds", "0.05", "--out", str(tmp_path), "--no-video"]
    assert call_unread(*asked) == (0, "")  # it was 1, and with a film no report.html
    names = ["summary.json", "log.npz", "timing.npz"]
    names += [] if extras.missing() else ["report.html"]
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(names)


@pytest.mark.parametrize("words", [["list"], ["mission", "casualty"], ["run", "--help"]])
def test_a_pipe_that_is_gone_is_no_error_and_a_full_disk_is_a_line(words: list[str]) -> None:
    assert call_unread(*words) == (0, "")
    with open("/dev/full", "w") as full:
        code, complaint = call_into(full.fileno(), *words)
    assert code == 1
    said = "hurcules: error: cannot write standard output: No space left on device\n"
    assert complaint == said


@pytest.mark.parametrize("words", [["run", "--help"], ["run", "--seconds", "0.05", "--no-video"]])
def test_an_encoding_without_degrees_and_bars_is_no_error(words: list[str], tmp_path: Path) -> None:
    done = subprocess.run(
        [*COMMAND, *words],
        env={**os.environ, "PYTHONIOENCODING": "ascii"},
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.isascii() and len(done.stdout) > 1000
