"""Missions in files: hurcules-sim runs them, without Python, to the bits of `hurcules run`.

Strategy: the same options for both, every column of the log; files with one thing wrong. The words
of such files are tests/cpp/mission/table_file_test.cpp's matter.
"""

from __future__ import annotations

import hashlib
import io
import json
import signal
import subprocess
import time
from collections.abc import Mapping
from pathlib import Path

import mujoco
import numpy as np
import pytest
from rich.console import Console

from hurcules import Mission, Simulation, _core, _exec, cli
from hurcules.run import RunOptions, run
from hurcules.sensors import realistic
from hurcules.table_missions import TABLE_MISSIONS

SEED, SECONDS = 11, 5.0
ASKED = {
    "lift": ["--mass", "90", "--offset", "0.05,-0.1", "--yaw", "0.2"],
    "casualty": ["--mass", "120", "--friction=0.6", "--pose", "back"],
    "crossing": ["--terrain", "ramps", "--way", "3", "--rise", "0.15"],
    "disposal": ["--mass", "20.5", "--yaw", "-0.1"],
}


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A lift as a file."""
    path = tmp_path_factory.mktemp("file") / "lift.table"
    assert cli.main(["mission", "lift", "--out", str(path)]) == 0
    return path


def program(*words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([_exec.program(), *words], capture_output=True, text=True)


def different(log: Mapping[str, np.ndarray], csv: Path) -> list[str]:
    """The columns of a log that differ from those of a file in any bit."""
    rows = np.loadtxt(csv, delimiter=",", skiprows=1)
    names = csv.read_text().partition("\n")[0].split(",")
    columns = {name: rows[:, i] for i, name in enumerate(names) if name != "tick_us"}
    assert set(columns) == set(log) - {"tick_us"}
    return [
        name
        for name, column in columns.items()
        if not np.array_equal(log[name], column, equal_nan=True)
    ]


@pytest.mark.slow
@pytest.mark.parametrize("name", ASKED)
def test_the_program_gives_the_bits_of_the_command(name: str, tmp_path: Path) -> None:
    table, csv = tmp_path / "mission.table", tmp_path / "log.csv"
    assert cli.main(["mission", name, *ASKED[name], "--out", str(table)]) == 0
    words = ["--seed", str(SEED), "--seconds", str(SECONDS)]
    summary = tmp_path / "program.json"
    done = program(str(table), *words, "--csv", str(csv), "--json", str(summary))
    assert done.returncode == 0, done.stderr
    parameters = TABLE_MISSIONS[name].parameters_of(ASKED[name])
    options = RunOptions(name, SEED, tmp_path / "run", SECONDS, video=False, parameters=parameters)
    run(options, Console(file=io.StringIO()))
    with np.load(tmp_path / "run" / "log.npz") as log:
        assert len(log["time"]) == round(SECONDS / 1e-3)
        assert different(log, csv) == []
    told, ran = (json.loads(one.read_text()) for one in (summary, tmp_path / "run/summary.json"))
    assert told["mission"] == name
    for same in ("seed", "sensors", "success"):
        assert told[same] == ran[same]
    assert [round(event["time_s"], 6) for event in told["events"]] == [
        event["time_s"] for event in ran["events"]
    ]
    assert [event["text"] for event in told["events"]] == [event["text"] for event in ran["events"]]
    assert told["figures"].items() <= ran["figures"].items()  # the command adds the battery's
    assert told["wanted"] == ran["wanted"]
    assert ("at least" in done.stdout) == bool(ran["wanted"])


def test_sensors_and_variation_are_those_of_a_simulation(file: Path, tmp_path: Path) -> None:
    csv = tmp_path / "log.csv"
    asked = ["--seed", "3", "--variation", "0.5", "--sensors", "--seconds", "0.5"]
    assert program(str(file), *asked, "--csv", str(csv)).returncode == 0
    simulation = Simulation("lift", 3, variation=0.5, sensors=realistic())
    simulation.step(500)
    assert different(simulation.log(), csv) == []
    assert "sensor/encoder_position/LSP" in simulation.log()
    other = Simulation("lift", 3, sensors=realistic())
    other.step(500)
    assert "q/LSP" in different(other.log(), csv)
    for words, wanted in (
        (["--variation", "-1"], "0 or more, got '-1'"),
        (["--noise"], "--sensors"),
    ):
        done = program(str(file), *words)
        assert (done.returncode, wanted in done.stderr) == (2, True)


@pytest.mark.parametrize("name", TABLE_MISSIONS)
def test_a_file_holds_what_the_table_says(name: str, tmp_path: Path) -> None:
    path = tmp_path / "mission.table"
    assert cli.main(["mission", name, "--out", str(path)]) == 0
    setup, rows = _core.read_table(str(path))
    table = TABLE_MISSIONS[name].table()
    assert setup == table.setup
    assert rows == table.rows


def test_a_table_of_ones_own_runs_in_the_scene_that_it_names(file: Path, tmp_path: Path) -> None:
    own, written = tmp_path / "own.toml", tmp_path / "lift.table"
    assert cli.main(["mission", "lift", "--out", str(own)]) == 0
    assert cli.main(["mission", str(own), "--out", str(written)]) == 0
    assert written.read_bytes() == file.read_bytes()
    rows = own.read_text().replace('name = "lift"', 'name = "own"\nscene = "lift"', 1)
    own.write_text(rows.replace("seconds = 1.5", "seconds = 0.2", 1))
    asked = ["--seconds", "0.4", "--no-video", "--mass", "90", "--out", str(tmp_path / "run")]
    assert cli.main(["run", str(own), *asked]) == 0
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert (summary["mission"], summary["file"]) == ("own", str(own))
    text = Mission.load(own).toml()
    assert summary["table_sha256"] == hashlib.sha256(text.encode()).hexdigest()
    assert Simulation(str(own), parameters={"mass": 90}).mission == "own"
    assert summary["events"][1]["time_s"] == 0.2


def test_a_table_without_a_scene_is_told(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    own = tmp_path / "own.toml"
    for scene in ("", 'scene = "lit"', "scene = 3"):
        own.write_text(f'[mission]\nname = "own"\n{scene}\n[[phase]]\nname = "a"\nstack = "arms"\n')
        assert cli.main(["run", str(own)]) == 2
    told = capsys.readouterr().err
    assert "own.toml: 'own' has no scene; [mission] wants scene, one of lift, casualty" in told
    assert "hurcules.Simulation(hurcules.Mission.load(...), model=..., controller=...)" in told
    assert "in a file of Python that hurcules run takes too; its table for C++: Mission." in told
    assert "scene 'lit' does not exist" in told
    assert "[mission], scene: wanted a text, got 3" in told
    assert cli.main(["run", str(tmp_path / "none.toml")]) == 2
    assert "none.toml" in capsys.readouterr().err


def test_the_table_of_a_robot_of_ones_own_is_written_for_cpp(tmp_path: Path) -> None:
    arm = '<mujoco><worldbody><body><joint/><geom size=".1"/></body></worldbody></mujoco>'
    model = mujoco.MjModel.from_xml_string(arm)
    path, phase = tmp_path / "own.table", {"name": "down", "stack": "reach", "seconds": 2.0}
    mission = Mission.read({"mission": {"name": "own"}, "phase": [phase]})
    mission.save_table(path, model)
    assert _core.read_table(str(path)) == (mission.setup, mission.rows)
    written = mujoco.MjModel.from_binary_path(str(tmp_path / "own.mjb"))
    assert written.names == model.names
    done = program(str(path))
    assert done.returncode == 2
    assert "controller of a table 'own' does not exist; there are: disposal, lift" in done.stderr
    with pytest.raises(_core.Error, match=r"kind of file '.mjb' does not exist"):
        mission.save_table(tmp_path / "own.mjb", model)


def test_a_file_that_was_broken_is_told(file: Path, tmp_path: Path) -> None:
    own, model = tmp_path / "lift.table", tmp_path / "lift.mjb"

    def told(text: str, contents: bytes | None) -> str:
        own.write_text(text)
        model.unlink(missing_ok=True)
        if contents is not None:
            model.write_bytes(contents)
        done = program(str(own), "--seconds", "0.01")
        assert done.returncode == 2
        assert done.stderr.count("\n") == 1
        return done.stderr

    text, compiled = file.read_text(), file.with_suffix(".mjb").read_bytes()
    assert f"lift.mjb' of '{own}' does not exist: write both anew" in told(text, None)
    assert "or it is cut off: write both anew (hurcules mission lift" in told(text, compiled[:-9])
    other = text.replace("mujoco 3", "mujoco 2")
    assert "was written by MuJoCo 2" in told(other, compiled)
    assert f"{own} is cut off" in told(text[:-4], compiled)
    assert "line 15: word 'phsae' does not exist; there are: mission, support, " in told(
        text.replace("phase settle", "phsae settle"), compiled
    )
    assert "no table of a mission" in told("[mission]\n", compiled)
    # names that the reader does not know are looked for in controller and log
    assert "controller of a table 'lft' does not exist; there are: disposal, lift" in told(
        text.replace("controller lift", "controller lft"), compiled
    )
    assert "phase 'settle': stack 'legs' does not exist; there are: " in told(
        text.replace("stack arms", "stack legs", 1), compiled
    )
    assert "casualty/height" in told(
        text.replace("casualty/heading_rad", "casualty/height"), compiled
    )


def test_what_is_no_file_of_a_mission_is_told(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    done = program(str(file), "--model", "other.xml")
    assert (done.returncode, "a table names its own model" in done.stderr) == (2, True)
    assert "cannot be read" in program(str(tmp_path / "none.table")).stderr
    folder = tmp_path / "folder.table"
    folder.mkdir()
    for words, wanted in (
        ([str(folder)], "cannot be read: it is a folder"),
        (["stretch", "--model", str(tmp_path)], "wanted a file, it is a folder"),
        (["stretch", "--json", ""], "--json: wanted a value, got ''"),
        (["stretch", "--seconds"], "--seconds: wanted a value after it"),
        (["stretch", "--second"], "option '--second' does not exist"),
        (
            ["stretch", "--seconds", "1e7"],
            "--seconds: wanted a time from 0.001 to 1e6 s, got '1e7'",
        ),
        (["stretch", "--sensors=off", "--seconds", "0.1"], "--sensors: wanted no value, got 'off'"),
    ):
        done = program(*words)
        assert (done.returncode, wanted in done.stderr) == (2, True), done.stderr
    assert "--version" in program("--help").stdout
    assert "FILE.table" in program("--help").stdout
    assert "there are: stretch, and what hurcules mission NAME" in program("lift").stderr
    for words, wanted in (
        (["my.toml", "--out", "my.table"], "mission file my.toml: No such file"),
        (["lift", "--weight", "75", "--out", "my.table"], "no such option: --weight"),
        (["lift", "--mass", "60", "--out", "my.table"], "mass"),
        (["lift", "--mass", "75", "--out", "my.svg"], "--mass: of the scene, which --out lift"),
        (["lift", "--mass", "900"], "--mass: of the scene, which --out lift.table writes"),
        (["--mass", "75", "lift"], "no such option: --mass"),
    ):
        assert cli.main(["mission", *words]) == 2
        assert wanted in capsys.readouterr().err


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_keeps_what_was_recorded(number: signal.Signals, tmp_path: Path) -> None:
    csv, summary = tmp_path / "log.csv", tmp_path / "summary.json"
    words = ["stretch", "--seconds=1000", "--csv", str(csv), f"--json={summary}"]
    process = subprocess.Popen([_exec.program(), *words], stdout=subprocess.PIPE, text=True)
    time.sleep(1.0)
    process.send_signal(number)
    said = process.communicate(timeout=60)[0]
    assert process.returncode == 128 + number
    assert f"interrupted; saved: {summary}, {csv}" in said
    assert json.loads(summary.read_text())["reason"].startswith("interrupted at ")
    assert len(csv.read_text().splitlines()) > 2


def test_a_summary_that_nobody_gets_is_told() -> None:
    with Path("/dev/full").open("w") as full:
        words = [_exec.program(), "stretch", "--seconds", "0.01"]
        done = subprocess.run(words, stdout=full, stderr=subprocess.PIPE, text=True)
    assert done.returncode == 1
    assert done.stderr == "hurcules-sim: the summary could not be written completely\n"


def test_one_file_is_not_for_both(tmp_path: Path) -> None:
    same = str(tmp_path / "a")
    done = program("stretch", "--seconds", "0.01", "--csv", same, "--json", same)
    assert done.returncode == 2
    assert done.stderr == f"hurcules-sim: --json and --csv name one file, '{same}'\n"


def test_a_model_that_does_not_fit_is_named(tmp_path: Path) -> None:
    model = tmp_path / "other.xml"
    model.write_text("<mujoco><worldbody><geom size='1'/></worldbody></mujoco>")
    done = program("stretch", "--model", str(model))
    assert done.returncode == 2
    assert done.stderr.startswith(f"hurcules-sim: model '{model}' does not fit 'stretch': ")
