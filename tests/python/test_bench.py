"""The command `hurcules bench`. Not tested: any time."""

import json
import math
from pathlib import Path

import pytest

from hurcules.output import WriteError
from hurcules_envs.bench import bench


def test_every_ratio_is_measured_printed_and_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "bench.json"
    bench(seconds=0.01, rounds=1, out=file)
    figures = json.loads(file.read_text())
    assert len(figures) == 5
    for one in figures:
        assert 0.0 < one["least"] <= one["value"] <= one["largest"] < math.inf
    words = " ".join(capsys.readouterr().out.split())
    assert "than" in words and "Gymnasium's" in words


def test_a_file_that_cannot_be_written_is_said_before_anything_is_measured(tmp_path: Path) -> None:
    with pytest.raises(WriteError, match="cannot write"):
        bench(seconds=1e9, rounds=1, out=tmp_path / "missing" / "bench.json")
