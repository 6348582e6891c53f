"""docs/field_tests.md says what the results beside it say, and these are results of the methods.

Not tested: the results themselves, hours of simulation; `hurcules run METHOD` repeats any of them.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from hurcules import models, scenes
from hurcules_studies import field_tests


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return (root / "docs" / "field_tests.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def results(root: Path) -> list[dict[str, Any]]:
    files = sorted((root / "docs" / "field_tests").glob("*.json"))
    return [json.loads(file.read_text(encoding="utf-8")) for file in files]


def test_the_table_is_what_the_script_writes(root: Path, page: str) -> None:
    program = "import field_tests as m; print(m.BEGIN + m.table() + m.END, end='')"
    written = subprocess.run(
        [sys.executable, "-B", "-c", program],
        cwd=root / "benchmarks/figures",
        capture_output=True,
        text=True,
    )
    assert written.returncode == 0, written.stderr
    assert written.stdout in page


def test_results_are_of_methods_and_their_statistics_are_right(
    results: list[dict[str, Any]],
) -> None:
    assert results
    for result in results:
        method = field_tests.method(result["mission"])
        assert result["robot"] in models.names()
        for one in result["settings"]:
            scenes.scene(method.scene, **method.values(one["setting"]))
            n, failures = one["repetitions"], one["failures"]
            assert one["confidence_80"] == pytest.approx(field_tests.confidence(n, failures, 0.8))
            assert len(one["faults"]) == failures


def test_pictures_of_the_page_exist_and_are_small(root: Path, page: str) -> None:
    shown = re.findall(r"!\[[^]]+\]\(([^)]+)\)", page)
    assert shown
    assert max((root / "docs" / link).stat().st_size for link in shown) < 300_000
