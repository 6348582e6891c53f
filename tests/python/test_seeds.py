"""`hurcules run --seeds`: rows, what is said of them, and how a sweep ends and goes on.

Strategy: an arm of three joints whose seeds do what goes wrong: one a kind of trouble.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from hurcules import cli, seeds
from hurcules.seeds import sum_up

ARM = """
import os, signal, time
import hurcules, mujoco

LINK = '<body pos="0.3 0 0"><joint name="{0}" axis="0 1 0"/><geom size="0.02" mass="0.2"/>'
XML = '<mujoco><option timestep="0.002"/><worldbody>'
XML += ''.join(LINK.format(name) for name in 'abc') + '</body>' * 3 + '</worldbody><actuator>'
XML += ''.join(f'<motor joint="{name}" ctrlrange="-50 50"/>' for name in 'abc')
XML += '</actuator></mujoco>'


def simulation(seed=0, troubled=False, lone=False, pause=0.0, edited=False):
    time.sleep(pause)
    if edited:
        open(__file__, "a").write("# another\\n")
    if troubled and seed in (1, 2):
        raise ValueError(f"no place {seed}.5 m away")
    if troubled and seed == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    model = mujoco.MjModel.from_xml_string(XML)
    robot = hurcules.Robot(model)
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(robot, stacks={"posture": [posture]})
    if lone:
        return hurcules.Simulation(model=model, controller=controller)
    phase = {"name": "hold", "stack": "posture", "seconds": 0.1}
    least = 0.09 if seed != 4 else 9.0
    figure = {"name": "held_s", "quantity": "time", "least": least}
    table = {"mission": {"name": "m"}, "phase": [phase], "figure": [figure]}
    mission = hurcules.Mission.read(table)
    made = hurcules.Simulation(mission, seed, model=model, controller=controller)
    if troubled and seed == 5:
        made.data.qvel[:] = 1e13
    return made
"""


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("arm") / "arm.py"
    path.write_text(ARM)
    return path


def held(folder: Path) -> list[dict[str, Any]]:
    lines = (folder / "runs.jsonl").read_text(encoding="utf-8").splitlines()
    return sorted(map(json.loads, lines), key=lambda row: row["seed"])


def call(file: Path, folder: Path, *words: str) -> int:
    return cli.main(["run", str(file), "--out", str(folder), *words])


@pytest.fixture(scope="module")
def sweep(file: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sweep")
    assert call(file, folder, "--seeds", "7", "--workers", "2", "--troubled", "true") == 1
    return folder


def test_each_run_is_a_row_whatever_becomes_of_it(sweep: Path) -> None:
    rows = held(sweep)
    assert [row["seed"] for row in rows] == list(range(7))
    assert [row["success"] for row in rows] == [True, *[False] * 5, True]
    assert rows[0]["figures"]["held_s"] == pytest.approx(0.1, abs=0.01)
    assert rows[0]["simulated_seconds"] == pytest.approx(0.1, abs=0.01)
    assert rows[1]["reason"] == "ValueError: no place 1.5 m away (arm.py:17)"
    assert "its process died" in rows[3]["reason"]
    assert "held_s is" in rows[4]["reason"] and rows[4]["phase"] == "hold"
    assert "diverged" in rows[5]["reason"]
    assert all(row["parameters"] == {"troubled": True} for row in rows)


def test_the_summary_classes_failures_and_spans_figures(sweep: Path) -> None:
    text = (sweep / "runs.txt").read_text(encoding="utf-8")
    lines = [line.split("   ") for line in text.splitlines()]
    assert text.startswith("arm: 2 of 7 succeeded (8 to 64 %, Wilson's 95 % interval)\n")
    assert [next(line[i] for line in lines if "no place" in line[0]) for i in (0, -1)] == [
        "ValueError: no place ... m away (arm.py:17)",
        "1, 2",
    ]
    held_s = next(line for line in text.splitlines() if line.startswith("held s"))
    assert "at least 0.0900 s, missed by 1" in held_s
    assert (sweep / "runs.png").read_bytes().startswith(b"\x89PNG")


def test_a_sweep_goes_on_where_it_was_cut_off(
    file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert call(file, tmp_path, "--seeds", "1", "--seed", "6") == 0
    path = tmp_path / "runs.jsonl"
    before = path.read_text()
    path.write_text(before + before[:50])  # the next line was cut off
    assert call(file, tmp_path, "--seeds", "2", "--seed", "6") == 0
    assert path.read_text().startswith(before)
    assert [row["seed"] for row in held(tmp_path)] == [6, 7]
    monkeypatch.setattr(seeds, "_row", None)  # nothing is left to run
    assert call(file, tmp_path, "--seeds", "2", "--seed", "6") == 0
    said = capsys.readouterr().out
    assert "2 of 2 runs are in" in said and "arm: 2 of 2 succeeded" in said
    assert call(file, tmp_path, "--seeds", "2", "--seed", "6", "--seconds", "0.05") == 2
    assert "is of other runs: seconds (there None, now 0.05)" in capsys.readouterr().err
    path.write_text("3\n")
    assert call(file, tmp_path, "--seeds", "2") == 2
    assert f"cannot read {path}" in capsys.readouterr().err


def test_without_a_mission_the_seconds_are_all_that_is_asked(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert call(file, tmp_path, "--seeds", "1", "--lone", "true") == 2
    assert "no mission that ends; --seconds wanted" in capsys.readouterr().err
    assert not (tmp_path / "runs.jsonl").exists()
    assert call(file, tmp_path, "--seeds", "1", "--lone", "true", "--seconds", "0.05") == 0
    assert held(tmp_path)[0]["reason"] == "stopped at 0.050 s, as asked"
    assert "1 of 1 succeeded" in capsys.readouterr().out


def begun(file: Path, folder: Path) -> subprocess.Popen[str]:
    """A sweep in a session of its own, whose first run has ended."""
    words = ["run", str(file), "--seeds", "60", "--pause", "0.2", "--out", str(folder)]
    process = subprocess.Popen(
        [sys.executable, "-m", "hurcules", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    deadline = time.monotonic() + 120
    while not (folder / "runs.jsonl").exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    return process


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_keeps_the_runs_that_have_ended(
    number: signal.Signals, file: Path, tmp_path: Path
) -> None:
    process = begun(file, tmp_path)
    os.killpg(process.pid, number)  # as the terminal does: to the workers too
    said, errors = process.communicate(timeout=60)
    assert process.returncode == 130, errors
    assert "Traceback" not in errors
    rows = held(tmp_path)
    assert 0 < len(rows) < 60
    assert [row["success"] for row in rows] == [row["seed"] != 4 for row in rows]
    assert f"interrupted: {len(rows)} of 60 runs; the same command goes on" in said


def test_workers_end_with_a_sweep_that_is_killed(file: Path, tmp_path: Path) -> None:
    process = begun(file, tmp_path)
    process.kill()
    process.communicate(timeout=60)  # the workers hold its pipes as long as they are there


def test_a_file_that_changes_meanwhile_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "arm.py"
    file.write_text(ARM)
    assert call(file, tmp_path, "--seeds", "1", "--edited", "true") == 2
    assert "arm.py: it has changed while it was run" in capsys.readouterr().err


def test_without_matplotlib_the_rest_is_done(
    sweep: Path, file: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(seeds.extras, "without", lambda: "matplotlib is not installed")
    assert call(file, sweep, "--seeds", "7", "--troubled", "true") == 1
    assert "no picture: matplotlib is not installed" in capsys.readouterr().out
    assert (sweep / "runs.txt").exists() and not (sweep / "runs.png").exists()


def test_a_mission_by_name_is_stopped_as_asked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["run", "lift", "--seeds", "1", "--seconds", "0.1", "--mass", "90"]
    assert cli.main([*words, "--out", str(tmp_path)]) == 0
    row = held(tmp_path)[0]
    assert (row["success"], row["phase"], row["parameters"]["mass"]) == (None, "settle", 90)
    assert row["figures"]["energy_J"] > 0 and row["wanted"]["held_height_m"]["least"] == 0.3
    assert "lift: 1 stopped before their end, as asked" in capsys.readouterr().out


def test_without_variation_all_seeds_run_alike(tmp_path: Path) -> None:
    words = ["run", "lift", "--seeds", "2", "--seconds", "0.02", "--variation", "0"]
    assert cli.main([*words, "--out", str(tmp_path)]) == 0
    first, second = held(tmp_path)
    assert (first["variation"], first["figures"]) == (0.0, second["figures"])


def test_reasons_that_differ_in_names_stay_apart() -> None:
    row = {"success": False, "phase": "a", "figures": {}, "wanted": {}}
    reasons = ("arm1 is 0.5 m", "arm2 is 0.5 m", "arm2 is 0.6 m")
    rows = [{**row, "seed": seed, "reason": reason} for seed, reason in enumerate(reasons)]
    text = sum_up("m", rows)
    assert "\narm2 is ... m" in text and "\narm1 is 0.5 m" in text


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        (["--video"], "--video: of one run, not with --seeds"),
        (["--repetitions", "3"], "--repetitions: for test methods"),
        (["--seeds", "0"], "--seeds: wanted a whole number from 1 up, got 0"),
        (["--workers", "0"], "--workers: wanted a whole number from 1 up, got 0"),
        (["--seed", "-1"], "--seed: wanted 0 or more, got -1"),
        (["--length", "2"], "no such option: --length"),
    ],
)
def test_what_does_not_fit_is_refused(
    words: list[str],
    wanted: str,
    file: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert call(file, tmp_path / "out", "--seeds", "2", *words) == 2
    assert wanted in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_other_wrong_use_is_refused(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for words, wanted in (
        ("run e2803 --seeds 2", "--seeds: for missions; 'e2803' is a test method"),
        ("run --policy Reach-v0 --seeds 2", "--seeds: not with --policy"),
        ("run lift --workers 2", "--workers: for test methods and --seeds"),
        ("run lift --seeds 2 --method best", "best"),
        ("run lift --seeds 2 --variation -1", "variation: wanted a number >= 0, got -1"),
        ("run e2803 --variation 0", "--variation: for missions; 'e2803' is a test method"),
    ):
        assert cli.main(words.split()) == 2
        assert wanted in capsys.readouterr().err
