"""`hurcules run`: what it writes, what it says, and how it ends when something goes wrong.

A whole mission is run by `make demo`, not here: these runs are cut short with --seconds.
"""

import hashlib
import io
import json
import os
import re
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import imageio.v2 as imageio
import mujoco
import numpy as np
import pytest
from rich.console import Console

import hurcules
from hurcules import extras, lift, report
from hurcules import run as runs
from hurcules.figures import readable, wanted
from hurcules.recording import CHANNELS, STAGES
from hurcules.report import plots
from hurcules.report.style import applied
from hurcules.run import DONE, FAILED, RunOptions, run
from hurcules.video import NOTE, STRIP

COMMAND = [sys.executable, "-c", "import sys; from hurcules.cli import main; sys.exit(main())"]
SECONDS = 2.4  # the stretch begins at 2 s


@pytest.fixture
def without_report(monkeypatch: pytest.MonkeyPatch) -> None:
    """Runs whose logs are compared leave the report out: it takes longer than they do."""
    monkeypatch.setattr(extras, "missing", lambda: ["jinja2"])


def quiet() -> Console:
    return Console(file=io.StringIO(), width=100)


def said(console: Console) -> str:
    assert isinstance(console.file, io.StringIO)
    return console.file.getvalue()


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """A short run with film: its folder and what it said."""
    out, console = tmp_path_factory.mktemp("run") / "deep" / "out", quiet()
    assert run(RunOptions(out=out, seconds=SECONDS), console) == DONE
    return out, said(console)


@pytest.fixture(scope="module")
def summary(result: tuple[Path, str]) -> dict[str, Any]:
    text = (result[0] / "summary.json").read_text(encoding="utf-8")
    found: dict[str, Any] = json.loads(text)
    return found


def test_a_run_writes_its_files_and_says_where(result: tuple[Path, str]) -> None:
    out, text = result
    names = ["log.npz", "report.html", "summary.json", "timing.npz", "video.mp4"]
    assert sorted(path.name for path in out.iterdir()) == names
    joined = text.replace("\n", "")
    assert [name for name in names if f"{out / name}" not in joined] == []


def test_the_summary_has_all_that_it_always_has(summary: dict[str, Any]) -> None:
    assert summary["mission"] == "stretch"
    assert summary["seed"] == 0
    assert summary["version"] == hurcules.__version__
    assert summary["simulated_seconds"] == pytest.approx(SECONDS)
    assert summary["success"] is False
    assert summary["reason"] == "stopped at 2.400 s, as asked"
    assert summary["real_time_factor"] > 0
    tick = summary["control_tick_us"]
    assert 0 < tick["median"] <= tick["p99"] <= tick["max"]
    worst = summary["limit_violation"]
    for excess in (worst, worst["commanded"]):
        assert all(excess[name] >= 0 for name in ("position_rad", "velocity", "torque"))
    assert worst["commanded"]["position_rad"] == 0


def test_the_summary_says_which_limits_held_and_of_which_model(
    summary: dict[str, Any], tmp_path: Path
) -> None:
    limits = summary["limits"]
    assert limits["KN"] == {"lower": -0.35, "upper": 3.25, "velocity": 0.6, "effort": 9000.0}
    assert summary["machine"]["numpy"] == np.__version__
    mujoco.mj_saveModel(hurcules.Simulation("stretch").model, str(tmp_path / "scene.mjb"), None)
    checksum = hashlib.sha256((tmp_path / "scene.mjb").read_bytes()).hexdigest()
    assert summary["model_sha256"] == checksum


def test_the_summary_has_the_thesis_beside_the_figures(summary: dict[str, Any]) -> None:
    assert set(summary["thesis"]) <= set(summary["figures"])
    assert summary["thesis"]["hip_locked_s"] == 15.0
    assert summary["thesis"]["pelvis_error_m"] == 0.40
    assert summary["figures"]["hip_locked_s"] is None  # not in so short a run


def test_every_figure_of_the_missions_is_described() -> None:
    from hurcules.figures import FIGURES

    of_log = {"energy_J", "battery_share", "yielded_s"}  # of every mission, added by the summary
    given = [hurcules.Simulation(mission).figures() for mission in hurcules.missions()]
    assert set().union(*given) == set(FIGURES) - of_log


def test_figures_are_told_with_their_units_and_their_names_whole(tmp_path: Path) -> None:
    assert readable("head_mps2", 34.94) == "34.9 m/s²"
    assert readable("case_sinking_mps", 0.131) == "0.131 m/s"
    assert readable("energy_margin_J", 2.06) == "2.06 J"
    assert readable("energy_J", 133787.0) == "133.8 kJ"
    both = {"least": 0.5, "most": 2.0}
    assert wanted("held_m", both, 2.5) == "at least 0.500 m, at most 2.00 m, missed"
    assert wanted("held_m", both, 0.5) == wanted("held_m", both, None)
    assert wanted("held_m", None, 2.5) == ""
    own = tmp_path / "own.toml"
    own.write_text(
        '[mission]\nname = "own"\nscene = "lift"\n'
        '[[phase]]\nname = "wait [s]"\nstack = "arms"\nseconds = 0.1\n'
        '[[figure]]\nname = "speed [m]"\nquantity = "time"\nmost = 0.01\n'
    )
    console = quiet()
    options = RunOptions(str(own), out=tmp_path / "out", video=False)
    assert run(options, console) == FAILED
    assert "failed: speed [m] is 0.099, wanted at most 0.01" in said(console)
    assert said(console).count("speed [m] ") == 2  # brackets are no markup
    assert "wait [s]" in said(console)
    assert "at most 0.01, missed" in said(console)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["wanted"] == {"speed [m]": {"least": None, "most": 0.01}}
    own.write_text(
        '[mission]\nname = "own"\nscene = "lift"\n'
        '[[phase]]\nname = "wait"\nstack = "arms"\nseconds = 0.1\nlast = true\n'
        '[[phase]]\nname = "never"\nstack = "arms"\nseconds = 0.1\n'
        '[[figure]]\nname = "speed"\nquantity = "time"\nphases = ["never"]\nmost = 0.01\n'
    )
    console = quiet()
    options = RunOptions(str(own), out=tmp_path / "never", video=False)
    with pytest.warns(UserWarning, match="never"):
        assert run(options, console) == FAILED
    assert "failed: speed has no value, wanted at most 0.01" in said(console)


def test_a_posture_that_is_blocked_is_told(tmp_path: Path) -> None:
    # the left blade jams on the robot's own track: "completed" and not a word, 0.8 rad short
    own = tmp_path / "own.toml"
    own.write_text(
        '[mission]\nname = "wave"\nscene = "lift"\n'
        '[[phase]]\nname = "wave"\nstack = "posture"\nseconds = 3\nposture = "posture"\n'
        "keys = [{ LSP = 1.0, LEB = 1.0 }]\n"
    )
    console = quiet()
    assert run(RunOptions(str(own), out=tmp_path / "out", video=False), console) == DONE
    figures = json.loads((tmp_path / "out" / "summary.json").read_text())["figures"]
    log = np.load(tmp_path / "out" / "log.npz")
    assert log["q/LSP"][-1] > 1.5
    assert figures["yielded_s"] == pytest.approx(np.count_nonzero(log["yielding"]) * 1e-3)
    assert figures["yielded_s"] > 1.5
    assert "the reference yielded for" in said(console)


def test_the_log_holds_every_tick_of_every_documented_channel(result: tuple[Path, str]) -> None:
    log = np.load(result[0] / "log.npz")
    documented = {word.split("/")[0] for names, _ in CHANNELS for word in names.split(", ")}
    assert {name.split("/")[0] for name in log.files} == documented
    assert {log[name].shape for name in log.files} == {(round(1000 * SECONDS),)}
    assert {log[name].dtype for name in log.files} == {np.dtype(np.float64)}
    np.testing.assert_allclose(np.diff(log["time"]), 1e-3)


def test_the_timings_hold_every_stage(result: tuple[Path, str]) -> None:
    assert ", ".join(np.load(result[0] / "timing.npz").files) == STAGES


# imageio's reader, not its writer, leaves pipes open
@pytest.mark.filterwarnings(
    "ignore:unclosed file", "ignore::pytest.PytestUnraisableExceptionWarning"
)
def test_the_film_is_h264_and_plays_at_twice_the_speed(result: tuple[Path, str]) -> None:
    with imageio.get_reader(result[0] / "video.mp4") as reader:
        facts = reader.get_meta_data()
        pictures = [picture for picture in reader]
    assert facts["codec"] == "h264"
    assert facts["size"] == (1280, 720)
    assert len(pictures) / facts["fps"] == pytest.approx(SECONDS / 2, abs=0.06)
    assert np.std(pictures[0][:600]) > 10  # something is drawn
    assert np.mean(np.abs(pictures[0].astype(int) - pictures[-1])) > 0.1  # and something moved


def test_the_report_needs_no_other_file(result: tuple[Path, str]) -> None:
    page = (result[0] / "report.html").read_text(encoding="utf-8")
    assert 'src="http' not in page
    assert 'href="http' not in page
    assert "data:video/mp4;base64," in page
    assert "break-after: avoid" in page  # no heading alone at the foot of a printed page
    assert page.count("<svg") == 20  # panels, that a phone shows one below the other
    for title in ("Joint positions", "Control errors", "Task errors", "Active limits"):
        assert f"<h2>{title}</h2>" in page


# imageio's reader, not its writer, leaves pipes open
@pytest.mark.filterwarnings(
    "ignore:unclosed file", "ignore::pytest.PytestUnraisableExceptionWarning"
)
def test_the_film_of_a_rescue_says_what_goes_on_and_the_report_what_is_done_to_the_person(
    tmp_path: Path,
) -> None:
    out = tmp_path / "casualty"
    assert run(RunOptions("casualty", out=out, seconds=2.0), quiet()) == DONE
    with imageio.get_reader(out / "video.mp4") as reader:
        pictures = [picture for picture in reader]
    assert len(pictures) == 5  # every 0.5 s
    note = pictures[-1][STRIP + 4 : STRIP + NOTE - 4]  # light, with dark letters on its left
    assert np.median(note) > 200
    assert np.min(note[:, :640]) < 100 < np.min(note[:, 900:])
    page = (out / "report.html").read_text(encoding="utf-8")
    assert "<h2>The person</h2>" in page
    assert "casualty/force/R" in page
    assert "<h2>Beside the thesis</h2>" not in page  # which has no figures of it
    assert "stand for 1.5 s" in page
    assert "Largest force of the robot on each region: none." in page  # 2 s: it drives up to him
    assert "at least 90.00 %" in page  # of the weight on the bed
    for drawn in re.findall("<svg.*?</svg>", page, flags=re.DOTALL):  # no word is cut off below
        height = float(re.findall(r'viewBox="0 0 [\d.]+ ([\d.]+)"', drawn)[0])
        assert max(float(y) for y in re.findall(r'<text[^>]* y="([\d.]+)"', drawn)) < height - 1


def test_the_report_has_each_force_on_the_person_beside_its_limit() -> None:
    time = np.arange(4.0)
    log = {"time": time, "casualty/on_ground": np.array([1.0, 0.2, 0.1, 0.0])}
    log |= {f"casualty/{name}": 0.1 * time for name in ("contact_share", "support_n")}
    log |= {f"casualty/on_{name}": 0.1 * time for name in ("left_arm", "right_arm", "bed")}
    log["casualty/head_mps2"] = 9.8 + time
    log["casualty/force/L_thigh"] = np.array([0.0, 330.0, 400.0, 0.0])
    log["casualty/force/skull"] = np.zeros(4)
    assert report._regions(log).endswith("left thigh contact 330 N of 220 N, carries 400 N.")
    with applied():
        page = plots.person(log, [])
    assert "left thigh" in page and "limit of a contact" in page
    assert "skull" not in page  # nothing touched it


@pytest.mark.parametrize("mission", ["lift", "casualty", "crossing"])
def test_the_report_draws_the_force_that_the_tables_stop_at(mission: str) -> None:
    when = [one.when for row in lift.mission(mission).rows.phases for one in row.troubles]
    limits = {one.value for one in when if one.quantity == "casualty/support_n"}
    assert limits == {plots.SUPPORT}


@pytest.mark.usefixtures("without_report")
def test_the_same_seed_gives_the_same_file_and_another_seed_another(tmp_path: Path) -> None:
    logs = []
    for name, seed in (("a", 3), ("b", 3), ("c", 4)):
        options = RunOptions(out=tmp_path / name, seed=seed, seconds=0.3, video=False)
        assert run(options, quiet()) == DONE
        logs.append((tmp_path / name / "log.npz").read_bytes())
    assert logs[0] == logs[1]
    assert logs[0] != logs[2]


@pytest.mark.usefixtures("without_report")
def test_sensors_with_noise_change_the_run_and_the_summary_names_them(tmp_path: Path) -> None:
    logs, named = {}, {}
    for sensors in (False, True):
        out = tmp_path / str(sensors)
        assert run(RunOptions(out=out, seconds=0.3, video=False, sensors=sensors), quiet()) == DONE
        logs[sensors] = (out / "log.npz").read_bytes()
        named[sensors] = json.loads((out / "summary.json").read_text())["sensors"]
    assert named == {False: "exact", True: "realistic"}
    assert logs[False] != logs[True]


def test_summary_and_report_say_what_was_asked_of_the_mission(tmp_path: Path) -> None:
    asked = {"mass": 90, "offset": (0.05, -0.1)}
    options = RunOptions("lift", out=tmp_path, seconds=0.1, video=False, parameters=asked)
    assert run(options, quiet()) == DONE
    told = json.loads((tmp_path / "summary.json").read_text())["parameters"]
    wanted = {"mass": 90, "offset": [0.05, -0.1], "yaw": 0.0, "friction": 0.45, "pose": "back"}
    wanted["arms"] = "sides"
    assert told == wanted
    line = "mass 90 · offset 0.05, -0.1 · yaw 0.0 · friction 0.45 · pose back · arms sides · seed 0"
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert line in page
    assert "The mission was not finished: stopped at 0.100 s, as asked." in page
    assert "<h2>Monitors</h2>" in page and "Joint positions" not in page  # none has moved yet
    assert "Task errors" not in page  # nor missed anything


def test_plots_leave_no_coordinate_out() -> None:
    from hurcules.report import plots  # it wants hurcules[report]

    names = ["KN", "HIP", "WST", "NKY", "NKP", "LSP", "LSR", "LSY", "LEB", "RSP"]
    time = np.linspace(0.0, 1.0, 50)
    log = {
        f"{kind}/{name}": i * time for i, name in enumerate(names, 1) for kind in ("q", "qd_des")
    }
    drawn = plots.joint_velocities({"time": time, **log}, [])
    assert [name for name in names if f"({name})" not in drawn] == []


def test_in_a_folder_that_was_asked_for_only_the_same_run_is_replaced(
    tmp_path: Path, without_report: None
) -> None:
    options = RunOptions(out=tmp_path, seconds=0.1, video=False)
    (tmp_path / "video.mp4").write_text("my own")
    with pytest.raises(hurcules.Error, match=r"another run: no summary\.json tells of its files"):
        run(options, quiet())
    assert (tmp_path / "video.mp4").read_text() == "my own"
    (tmp_path / "video.mp4").rename(tmp_path / "mine.mp4")
    assert run(options, first := quiet()) == DONE
    (tmp_path / "report.html").write_text("old")
    assert run(options, again := quiet()) == DONE
    assert "takes the place" not in said(first)
    assert f"takes the place of the same run in {tmp_path}\n" in said(again)
    assert not (tmp_path / "report.html").exists() and (tmp_path / "mine.mp4").exists()
    before = (tmp_path / "summary.json").read_bytes()
    told = r"holds another run: seed \(there 0, now 7\); give another folder"
    with pytest.raises(hurcules.Error, match=told):
        run(replace(options, seed=7), quiet())
    with pytest.raises(hurcules.Error, match=r"seconds \(there 0.1, now 0.2\)"):
        run(replace(options, seconds=0.2), quiet())
    assert (tmp_path / "summary.json").read_bytes() == before


def test_the_usual_folder_holds_the_last_run_and_says_whose_place_it_takes(
    tmp_path: Path, without_report: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for seed in (0, 7):
        assert run(RunOptions(seed=seed, seconds=0.1, video=False), console := quiet()) == DONE
    place = Path("out", "stretch")
    assert f"takes the place of another run in {place}: seed (there 0, now 7)\n" in said(console)
    assert json.loads((place / "summary.json").read_text())["seed"] == 7


def test_without_a_renderer_the_rest_is_done_and_the_remedy_named(tmp_path: Path) -> None:
    done = subprocess.run(
        [*COMMAND, "run", "--seconds", "0.2", "--out", str(tmp_path)],
        env={**os.environ, "MUJOCO_GL": "disable", "COLUMNS": "300"},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    assert "no video: no usable renderer" in done.stdout
    assert "apt-get install" in done.stdout
    names = ["log.npz", "report.html", "summary.json", "timing.npz"]
    assert sorted(path.name for path in tmp_path.iterdir()) == names
    assert "No film: no usable renderer" in (tmp_path / "report.html").read_text()


def test_ctrl_c_saves_what_was_recorded_and_says_so(tmp_path: Path) -> None:
    # ends itself by Ctrl-C in the middle of the simulation, as a person would
    program = """
import os, signal, sys
from hurcules import cli, recording
moment = recording._moment
def interrupting(simulation):
    if simulation.time > 0.5:
        os.kill(os.getpid(), signal.SIGINT)
    return moment(simulation)
recording._moment = interrupting
sys.exit(cli.main())
"""
    done = subprocess.run(
        [sys.executable, "-c", program, "run", "--out", str(tmp_path)],
        env={**os.environ, "COLUMNS": "300"},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 128 + signal.SIGINT
    assert "Traceback" not in done.stderr
    assert "interrupted at 0.600 s; " in done.stdout
    assert f"saved in {tmp_path}: summary.json, log.npz, timing.npz, report.html" in done.stdout
    assert len(np.load(tmp_path / "log.npz")["time"]) == 600
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert (summary["success"], summary["reason"]) == (False, "interrupted at 0.600 s")


def test_ctrl_c_in_the_film_keeps_the_pictures_that_were_drawn(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    drawn = runs.Painter.frame

    def interrupting(painter: runs.Painter, frame: Any, note: str = "") -> Any:
        if frame.time > 0.35:
            signal.raise_signal(signal.SIGINT)
        return drawn(painter, frame, note)

    monkeypatch.setattr(runs.Painter, "frame", interrupting)
    console = quiet()
    assert run(RunOptions(out=tmp_path, seconds=1.0), console) == runs.INTERRUPTED
    assert "report.html" in said(console)
    with imageio.get_reader(tmp_path / "video.mp4") as reader:
        assert reader.count_frames() == 5  # at 0, 0.1, ... 0.4 s


@pytest.mark.parametrize("number", [1, 2])  # log.npz, timing.npz
def test_ctrl_c_while_saving_lets_everything_be_saved(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, number: int
) -> None:
    save, begun = np.savez_compressed, []

    def interrupting(file: Any, **arrays: Any) -> None:
        begun.append(file.name)
        if len(begun) == number:  # Ctrl-C comes when the file is open
            signal.raise_signal(signal.SIGINT)
        save(file, **arrays)

    monkeypatch.setattr(np, "savez_compressed", interrupting)
    before, console = signal.getsignal(signal.SIGINT), quiet()
    assert run(RunOptions(out=tmp_path, seconds=0.2), console) == 130
    assert signal.getsignal(signal.SIGINT) is before
    files = ["summary.json", "log.npz", "timing.npz", "report.html"]
    assert "interrupted after the simulation had ended at 0.200 s; saved in " in said(console)
    assert f"{tmp_path}: {', '.join(files)}" in said(console)
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(files)
    assert len(np.load(tmp_path / "log.npz")["time"]) == 200
    assert json.loads((tmp_path / "summary.json").read_text())["simulated_seconds"] == 0.2


def test_a_second_ctrl_c_says_what_was_saved(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def interrupting(*_: Any, **__: Any) -> None:
        signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(np, "savez_compressed", interrupting)
    assert run(RunOptions(out=tmp_path, seconds=0.2), console := quiet()) == 130
    assert f"interrupted while saving; saved in {tmp_path}: summary.json\n" in said(console)
    assert [path.name for path in tmp_path.iterdir()] == ["summary.json"]


def test_ctrl_c_between_the_simulation_and_saving_saves(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    summarize, console = runs.summarize, quiet()

    def interrupting(*arguments: Any) -> dict[str, Any]:
        signal.raise_signal(signal.SIGINT)
        return summarize(*arguments)

    monkeypatch.setattr(runs, "summarize", interrupting)
    assert run(RunOptions(out=tmp_path, seconds=0.2), console) == 130
    assert "before anything was recorded" not in said(console)
    assert (tmp_path / "summary.json").exists()


def test_ctrl_c_before_the_first_tick_leaves_no_files(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    class Interrupting(runs.Output):
        def __init__(self, *arguments: Any) -> None:
            super().__init__(*arguments)
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(runs, "Output", Interrupting)
    assert run(RunOptions(out=tmp_path, seconds=0.2), console := quiet()) == 130
    assert said(console).endswith("interrupted before anything was recorded\n")
    assert list(tmp_path.iterdir()) == []


def test_a_full_disk_gives_one_line_that_says_what_was_saved(tmp_path: Path) -> None:
    # a limit on the size of files stands for the full disk: timing.npz is smaller than log.npz
    program = """
import resource, sys
from hurcules import cli
resource.setrlimit(resource.RLIMIT_FSIZE, (60_000, 60_000))
sys.exit(cli.main())
"""
    done = subprocess.run(
        [sys.executable, "-c", program, "run", "--no-video", "--seconds", "0.3", "--out", tmp_path],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 1, done.stderr
    assert done.stderr.count("\n") == 1
    said = f"cannot write {tmp_path}/log.npz: File too large; saved in {tmp_path}: summary.json"
    assert said in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["summary.json"]


def test_a_mission_that_fails_says_why_and_ends_with_1(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    class Pushed(hurcules.Simulation):
        """A giant pushes the trunk over."""

        def step(self, n: int = 1, command: Any = None) -> int:
            self.data.body("waist").xfrc_applied[:3] = (-9000.0, 0.0, 0.0)
            return super().step(n, command)

    monkeypatch.setattr(runs, "Simulation", Pushed)
    console = quiet()
    assert run(RunOptions(out=tmp_path, video=False), console) == FAILED
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["success"] is False
    assert summary["reason"].startswith("fell over at ")
    assert summary["reason"] in said(console)
