"""docs/architecture.md says what the include and import lines say."""

import subprocess
import sys
from pathlib import Path

import pytest


@pytest.fixture
def script(root: Path) -> Path:
    return root / "benchmarks" / "figures" / "architecture.py"


def test_the_page_is_up_to_date(script: Path) -> None:
    done = subprocess.run([sys.executable, script, "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_a_new_arrow_and_another_size_are_noticed(script: Path) -> None:
    program = (
        "from architecture import outdated as o\n"
        "assert o('a --> b', 'a --> b') == []\n"
        "assert o('a --> b', 'a --> b\\na --> c') == ['@@ -1,0 +2 @@', '+a --> c']\n"
        "assert o('x 10 files, 1.0 k', 'x 12 files, 1.2 k') == []\n"
        "assert o('x 9 files 1.0 k', 'x 9 files 1.5 k') == ['x 9 files 1.0 k: 1.0 is now 1.5']\n"
        "assert o('x 10 files', 'x 14 files') == ['x 10 files: 10 is now 14']\n"
    )
    done = subprocess.run(
        [sys.executable, "-B", "-c", program], cwd=script.parent, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
