"""docs/scenes.md says what the code does: its list, its pictures, its program."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

from hurcules import scenes


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return (root / "docs" / "scenes.md").read_text(encoding="utf-8")


def test_the_list_is_what_the_script_writes(root: Path, page: str) -> None:
    program = "import scenes as m; print(m.MARK + '\\n' + m.gallery(), end='')"
    written = subprocess.run(
        [sys.executable, "-B", "-c", program],
        cwd=root / "benchmarks/figures",
        capture_output=True,
        text=True,
    )
    assert written.returncode == 0, written.stderr
    assert page.endswith(written.stdout) and len(written.stdout) > 1000


def test_every_kind_has_a_picture_that_is_small(root: Path, page: str) -> None:
    shown = {Path(link).stem for link in re.findall(r"\((scenes/\w+\.png)\)", page)}
    files = {file.stem: file.stat().st_size for file in (root / "docs" / "scenes").iterdir()}
    assert shown == set(files) and set(scenes.names()) <= shown
    assert max(files.values()) < 300_000


def test_the_programs_on_the_page_run(page: str, tmp_path: Path) -> None:
    programs = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    assert len(programs) == 2
    for program in programs:
        done = subprocess.run(
            [sys.executable, "-W", "error", "-c", program],
            cwd=tmp_path,
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stderr
