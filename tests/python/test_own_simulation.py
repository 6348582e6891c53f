"""`hurcules run FILE.py`: a simulation of one's own gets what a mission gets, mistakes are told.

Strategy: example 20 and a file of a few lines with one thing wrong at a time.
"""

from __future__ import annotations

import io
import json
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from hurcules import Error, own_simulation
from hurcules.cli import main
from hurcules.recording import yielding_levels
from hurcules.run import RunOptions, run

PENDULUM = """
import hurcules, mujoco

XML = '''<mujoco><compiler angle="radian"/><worldbody>
  <body><joint name="swing" axis="0 1 0" range="-1 1" limited="true"/>
  <geom type="capsule" size="0.02" fromto="0 0 0 0.3 0 0" mass="0.5"/></body></worldbody>
  <actuator><motor joint="swing" ctrlrange="-50 50"/></actuator></mujoco>'''


def simulation(mass=0.5, heavy=False, record=True):
    model = mujoco.MjModel.from_xml_string(XML)
    model.body_mass[1] = 2.0 if heavy else mass
    robot = hurcules.Robot(model)
    controller = hurcules.WholeBodyController(robot, [hurcules.PostureTask("posture", robot)])
    return hurcules.Simulation(model=model, controller=controller, record=record)
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "pendulum.py"
    path.write_text(PENDULUM)
    return path


def test_the_example_is_run_filmed_and_reported(root: Path, tmp_path: Path) -> None:
    example = str(root / "python" / "examples" / "20_pick.py")
    said = io.StringIO()
    parameters = own_simulation.parameters_of(example, ["--x", "-0.3"])
    assert parameters == {"x": -0.3}
    options = RunOptions(example, out=tmp_path, video=False, parameters=parameters)
    assert run(options, Console(file=said, width=100)) == 0
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert (summary["mission"], summary["parameters"]) == ("pick", {"x": -0.3})
    assert summary["wanted"]["cube_height_m"] == {"least": 0.25, "most": None}
    assert "method" not in summary
    log = np.load(tmp_path / "log.npz")
    assert log["position/cube/x"][0] == pytest.approx(-0.3, abs=0.1)  # its place is drawn
    page = (tmp_path / "report.html").read_text()
    assert "position [m]" in page
    assert "position [rad]" not in page  # both of its coordinates slide
    assert "centre of pressure" not in said.getvalue()  # it cannot tip over
    assert "at least 0.250 m" in said.getvalue()
    assert "battery" not in said.getvalue()  # that of Hurcules, which it has not


def test_one_without_a_mission_runs_as_long_as_it_is_told(file: Path, tmp_path: Path) -> None:
    options = RunOptions(str(file), out=tmp_path / "out", seconds=0.1, video=False)
    assert run(options, Console(file=io.StringIO())) == 0
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert (summary["mission"], summary["finished"]) == ("pendulum", False)
    assert not (tmp_path / "out" / "timing.npz").exists()  # made without timed=True
    with pytest.raises(Error, match="no mission that ends; --seconds wanted"):
        run(RunOptions(str(file), out=tmp_path / "out"), Console(file=io.StringIO()))


def test_parameters_come_from_the_command_line(file: Path) -> None:
    read = own_simulation.parameters_of(str(file), ["--mass", "0.8", "--heavy=true"])
    assert read == {"mass": 0.8, "heavy": True}
    made = own_simulation.make(str(file), parameters={"mass": 0.8})
    assert made.model.body_mass[1] == 0.8


@pytest.mark.parametrize(
    ("old", "new", "words", "wanted"),
    [
        ("", "", ["--length", "2"], "no such option: --length; options are: --mass, --heavy"),
        ("", "", ["--mass", "much"], "--mass: wanted a number, got 'much'"),
        ("", "", ["--heavy", "1"], "--heavy: wanted true or false, got '1'"),
        ("", "", ["--seed", "3"], "has no parameter seed, got 3"),
        ("", "", ["--sensors"], "--sensors: for missions by name"),
        ("", "", ["--record", "false"], "a run wants its log, this simulation has record=False"),
        ("def simulation", "def simulate", [], "wanted a function simulation(seed=0)"),
        ("return hurcules.Simulation", "hurcules.Simulation", [], "got None"),
        ("mass=0.5, heavy", "mass, heavy", [], "missing a required argument: 'mass'"),
        ("import hurcules, mujoco", "raise SystemExit(3)", [], "it ends by itself (exit 3)"),
        ("import hurcules, mujoco", "import hurkules", [], "line 2: ModuleNotFoundError: No mod"),
        ("import hurcules, mujoco", "import (", [], "line 2: "),
        ("return hurcules", "1 / 0; return hurcules", [], "line 15: ZeroDivisionError: division"),
    ],
)
def test_a_mistake_is_told(
    old: str,
    new: str,
    words: list[str],
    wanted: str,
    file: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    file.write_text(PENDULUM.replace(old, new))
    folder = tmp_path / "out"
    code = main(["run", str(file), "--seconds", "0.1", "--out", str(folder), "--no-video", *words])
    assert code == 2
    assert wanted in capsys.readouterr().err


def test_a_file_is_executed_once_as_a_module(tmp_path: Path) -> None:
    file = tmp_path / "pendulum.py"
    head = "from __future__ import annotations\nfrom dataclasses import dataclass\n"
    runs = tmp_path / "runs"
    runs.write_text("")
    counted = f"import pathlib\nruns = pathlib.Path({str(runs)!r})\n"
    counted += "runs.write_text(runs.read_text() + 'x')\n"
    kind = "@dataclass\nclass Link:\n    mass: float = 1.0\n"
    file.write_text(head + counted + kind + PENDULUM)
    words = ["run", str(file), "--seconds", "0.1", "--no-video", "--out", str(tmp_path / "out")]
    assert main([*words, "--mass", "0.8"]) == 0
    assert runs.read_text() == "x"


def test_no_file_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "nowhere.py"]) == 2
    assert "nowhere.py: no such file" in capsys.readouterr().err


def test_a_level_on_its_way_does_not_give_way() -> None:
    time = np.arange(0.0, 4.0, 0.01)
    log = {
        "time": time,
        "error/hand": np.clip(0.3 - 0.1 * time, 0.05, None),  # held off its target from 2.5 s on
        "error/posture": np.full(len(time), 0.005),
    }
    assert [yielding_levels(log, t) for t in (0.0, 1.0, 3.0)] == [(), (), ("hand",)]
