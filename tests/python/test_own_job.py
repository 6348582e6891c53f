"""`hurcules run FILE.py`: the mission of a robot of one's own, with log, film and report."""

import io
import json
from pathlib import Path

import pytest
from rich.console import Console

import hurcules
from hurcules import Error, cli
from hurcules.run import DONE, FAILED, RunOptions, run

JOB = """
import mujoco
import hurcules
from beside import WAY

XML = '''<mujoco><worldbody><geom type="plane" size="1 1 1"/><light pos="0 0 3"/>
  <camera name="film" pos="0 -2 1" xyaxes="1 0 0 0 0.4 1"/>
  <body name="hand" pos="0 0 0.5"><joint name="x" type="slide" axis="1 0 0" range="-1 1"/>
    <geom size="0.05" mass="1"/></body></worldbody>
  <actuator><motor joint="x" ctrlrange="-50 50"/></actuator></mujoco>'''


def job(seed, way=WAY, back=False):
    model = mujoco.MjModel.from_xml_string(XML)
    robot = hurcules.Robot(model)
    task = hurcules.PostureTask("rail", robot)
    channels = {"rail": hurcules.Twist(task, 1.0)}
    controller = hurcules.WholeBodyController(robot, channels=channels, stacks={"rail": [task]})
    by = (way + 0.01 * seed) * (-1 if back else 1)
    go = {"name": "go", "stack": "rail", "seconds": 0.4, "lead": {"rail": {"by": [by]}}}
    stay = {"name": "stay", "stack": "rail", "seconds": 0.1}
    bounds = {} if back else {"least": 0.1}
    figure = {"name": "x_m", "quantity": "position/hand/x", **bounds}
    table = {"mission": {"name": "rail"}, "phase": [go, stay], "figure": [figure]}
    return hurcules.Mission.read(table), model, controller
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    (tmp_path / "beside.py").write_text("WAY = 0.15\n")
    (tmp_path / "rail.py").write_text(JOB)
    return tmp_path / "rail.py"


def test_a_robot_of_ones_own_gets_all_that_a_mission_gets(file: Path, tmp_path: Path) -> None:
    console = Console(file=io.StringIO(), width=100)
    assert run(RunOptions(str(file), seed=2, out=tmp_path / "out"), console) == DONE
    names = sorted(path.name for path in (tmp_path / "out").iterdir())
    assert names == ["log.npz", "report.html", "summary.json", "timing.npz", "video.mp4"]
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert (summary["mission"], summary["seed"], summary["success"]) == ("rail", 2, True)
    assert summary["figures"]["x_m"] == pytest.approx(0.17, abs=4e-3)
    assert summary["wanted"]["x_m"]["least"] == 0.1
    page = (tmp_path / "out" / "report.html").read_text()
    assert "centre of mass inside" not in page  # it cannot tip over: no margin, no line
    assert "static margin" not in page
    assert "What the mission reads" in page
    assert "settling phase" not in page  # its first phase is part of the mission


def test_the_words_of_the_command_are_the_parameters_of_the_job(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["run", str(file), "--way", "0.2", "--no-video", "--out", str(tmp_path / "out")]
    assert cli.main([*words, "--back", "true"]) == DONE
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["parameters"] == {"way": 0.2, "back": True}
    assert summary["figures"]["x_m"] == pytest.approx(-0.2, abs=4e-3)
    assert "thesis" not in capsys.readouterr().out
    assert cli.main([*words[:2], "--way", "0.05", *words[4:]]) == FAILED
    assert "failed: x_m is 0.05" in capsys.readouterr().out
    for more, told in (
        (["--wya", "1"], "no such option: --wya; options are: --way, --back"),
        (["--way", "far"], "--way: wanted a number, got 'far'"),
        (["--back", "yes"], "--back: wanted true or false, got 'yes'"),
    ):
        assert cli.main(["run", str(file), *more]) == 2
        assert told in capsys.readouterr().err
    assert cli.main(["mission", str(file)]) == 0
    assert "rail by 0.15" in capsys.readouterr().out
    assert cli.main(["mission", str(file), "--out", str(tmp_path / "rail.table")]) == 2
    assert "hurcules-sim runs robots of the project" in capsys.readouterr().err


def test_a_simulation_of_a_file_is_the_same(file: Path) -> None:
    simulation = hurcules.Simulation(str(file), 1, variation=0.0, parameters={"way": 0.2})
    simulation.step(1000)
    assert simulation.success
    assert simulation.data.qpos[0] == pytest.approx(0.21, abs=4e-3)


@pytest.mark.parametrize(
    "text, told",
    [
        (None, "no such file"),
        ("robot = 1", "wants a function job"),
        (
            "def job(seed):\n    return seed",
            "job wants to return a hurcules.Mission, .*returned int",
        ),
    ],
)
def test_a_file_without_a_job_is_told(text: str | None, told: str, tmp_path: Path) -> None:
    file = tmp_path / "none.py"
    if text:
        file.write_text(text)
    with pytest.raises(Error, match=told):
        hurcules.Simulation(str(file))
