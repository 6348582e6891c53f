"""What a newcomer meets: a broken MuJoCo, Ctrl-C, a source tree, a prompt, a viewer, no extras.

Strategy: processes of their own with a made-up environment. Not tested: a real desktop.
"""

import fcntl
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import termios
import time
import traceback
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import cli, extras, legend, opengl, rhqp
from hurcules.interrupts import Interrupts, unheard_by_children

COMMAND = [sys.executable, "-m", "hurcules"]


def call(*words: str, cwd: Path | None = None, **environment: str) -> tuple[int, str, str]:
    done = subprocess.run(
        [*COMMAND, *words],
        env={**os.environ, **environment},
        cwd=cwd,
        capture_output=True,
        text=True,
        timeout=300,
    )
    return done.returncode, done.stdout, done.stderr


@pytest.mark.skipif(sys.platform != "linux", reason="a choice for Linux")
@pytest.mark.parametrize(("bound", "wanted"), [("egl", "egl"), ("osmesa", "osmesa"), ("glx", "")])
def test_what_pyopengl_is_bound_to_is_drawn_with(
    bound: str, wanted: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    # "Cannot use OSMesa ... PYOPENGL_PLATFORM ... is set to 'egl'", as images for training set it
    monkeypatch.setattr(opengl, "lacking", lambda backend: [])
    environment = {"PYOPENGL_PLATFORM": bound}
    assert opengl.choose_backend(environment) == environment.get("MUJOCO_GL", "") == wanted
    assert opengl.choose_backend({}) in ("egl", "osmesa")


def test_python_m_hurcules_is_the_command() -> None:
    assert call("--version") == (0, f"{hurcules.__version__}\n", "")


def test_a_wrong_opengl_ends_nothing_but_pictures(tmp_path: Path) -> None:
    words = ("run", "stretch", "--seconds", "0.1", "--out", str(tmp_path))
    code, out, err = call(*words, MUJOCO_GL="foo")
    assert (code, err) == (0, "")
    assert "no video" in out and "MUJOCO_GL" in out
    assert (tmp_path / "report.html").is_file() and not (tmp_path / "video.mp4").exists()
    code, out, err = call("doctor", MUJOCO_GL="foo")
    assert "MUJOCO_GL=foo" in " ".join(out.split()) and "Traceback" not in err
    assert code == 0  # a renderer is optional


def script() -> str:
    return str(Path(sys.executable).with_name("hurcules"))


@pytest.mark.parametrize("broken", ['__version__ = "2.3.7"', "raise OSError('no libmujoco')"])
def test_doctor_survives_a_broken_mujoco(tmp_path: Path, broken: str) -> None:
    (tmp_path / "mujoco.py").write_text(broken + "\n")
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
    done = subprocess.run([script(), "doctor"], env=environment, capture_output=True, text=True)
    assert done.returncode == 1
    assert "Traceback" not in done.stderr
    row = next(line for line in done.stdout.splitlines() if line.startswith("MuJoCo"))
    assert "broken" in row and ("2.3.7" in row or "no libmujoco" in row)
    assert "remedy: pip install --force-reinstall mujoco==" in done.stdout
    done = subprocess.run([script(), "list"], env=environment, capture_output=True, text=True)
    assert done.returncode == 1
    assert done.stderr.startswith("hurcules: error: ") and done.stderr.count("\n") == 1


@pytest.mark.parametrize("broken", [True, False])
def test_hurcules_sim_imports_nothing(tmp_path: Path, broken: bool) -> None:
    # it imported the package first: 0.7 s, and a traceback where MuJoCo was missing or broken
    code, said = 1, "hurcules-sim: MuJoCo is not installed; remedy: hurcules doctor\n"
    begin = "import sys, hurcules_command; sys.argv = ['hurcules-sim', '--version']; "
    if broken:
        (tmp_path / "mujoco.py").write_text("raise OSError('no libmujoco')\n")
        code, said = 0, f"hurcules-sim {hurcules.__version__}\n"
    else:
        begin += "sys.modules['mujoco'] = None; "
    done = subprocess.run(
        [sys.executable, "-c", begin + "sys.exit(hurcules_command.simulate())"],
        env={**os.environ, "PYTHONPATH": f"{tmp_path}:{os.environ.get('PYTHONPATH', '')}"},
        capture_output=True,
        text=True,
    )
    assert (done.returncode, done.stdout + done.stderr) == (code, said)


def test_a_folder_that_was_deleted_is_told(tmp_path: Path) -> None:
    gone = tmp_path / "gone"
    gone.mkdir()
    code = f"import os; os.chdir({str(gone)!r}); os.rmdir({str(gone)!r}); import hurcules"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    last = done.stderr.splitlines()[-1]  # it said: pip install --force-reinstall mujoco
    assert last.startswith("ImportError: the folder that this runs in was deleted; remedy: cd ")


def test_the_source_tree_says_that_it_is_not_compiled(root: Path, tmp_path: Path) -> None:
    shutil.copytree(root / "python" / "hurcules", tmp_path / "hurcules")
    for compiled in (tmp_path / "hurcules").glob("*.so"):
        compiled.unlink()
    code = "import sys; sys.meta_path = [f for f in sys.meta_path if 'ditable' not in repr(f)]; "
    done = subprocess.run(
        [sys.executable, "-c", code + "import hurcules"],
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
    )
    last = done.stderr.splitlines()[-1]
    assert last.startswith("ImportError: hurcules in ") and "not compiled" in last
    assert "remedy: pip install ." in last


def used(group: int) -> float:
    """Processor time of a group of processes [s]."""
    ticks = 0
    for file in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):  # it has ended
            stat = file.read_text().rpartition(")")[2].split()  # after its name
            if int(stat[2]) == group:
                ticks += int(stat[11]) + int(stat[12])
    return ticks / os.sysconf("SC_CLK_TCK")


def interrupt(words: list[str], after: float, busy: float = 0.0) -> tuple[int, str, float]:
    """Exit code, what was said, and the seconds from Ctrl-C to the end.

    Ctrl-C comes `after` seconds after the console script has begun, and not before its processes
    have used `busy` seconds of the processor: a crowded machine does not make it come too early.
    """
    begin = f"import sys, hurcules_command; sys.argv = ['hurcules', *{words!r}]; "
    begin += "print('ready', flush=True); sys.exit(hurcules_command.main())"
    process = subprocess.Popen(
        [sys.executable, "-c", begin],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    assert process.stdout is not None and process.stdout.readline() == "ready\n"
    time.sleep(after)
    while process.poll() is None and used(process.pid) < busy:
        time.sleep(0.05)
    assert process.poll() is None, "it had ended before Ctrl-C"
    started = time.perf_counter()
    os.killpg(process.pid, signal.SIGINT)
    said = process.communicate(timeout=120)[0]
    return process.returncode, said, time.perf_counter() - started


@pytest.mark.parametrize("after", [0.02, 0.1, 0.25])
def test_ctrl_c_during_the_import_is_no_traceback(tmp_path: Path, after: float) -> None:
    code, said, _ = interrupt(["run", "stretch", "--no-video", "--out", str(tmp_path)], after)
    assert "Traceback" not in said
    assert code == 130


@pytest.mark.slow
@pytest.mark.parametrize("workers, busy", [("1", 7.0), ("2", 14.5)])
def test_ctrl_c_ends_a_method_at_once(tmp_path: Path, workers: str, busy: float) -> None:
    # in the second repetition of each: 1 s to begin, of each process, and 5 s a repetition
    words = ["run", "e2803", "--angle", "20", "--no-video", "--workers", workers]
    code, said, seconds = interrupt([*words, "--out", str(tmp_path)], 0.0, busy)
    assert code == 130, said
    assert "interrupted" in said and "Traceback" not in said
    assert seconds < 5.0  # a second on a quiet machine


def test_a_terminal_that_closes_loses_no_run(tmp_path: Path) -> None:
    ours, theirs = os.openpty()
    words = ["run", "stretch", "--no-video", "--out", str(tmp_path)]
    begin = f"import sys, hurcules_command; sys.argv = ['hurcules', *{words!r}]; "
    process = subprocess.Popen(
        [sys.executable, "-c", begin + "sys.exit(hurcules_command.main())"],
        stdin=theirs,
        stdout=theirs,
        stderr=theirs,
        start_new_session=True,
        preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0),  # it is the process's own
    )
    os.close(theirs)
    said = b""
    while b"real time" not in said:  # the simulation runs
        said += os.read(ours, 4096)
    os.close(ours)
    assert process.wait(timeout=120) == 130
    assert json.loads((tmp_path / "summary.json").read_text())["reason"].startswith(
        "interrupted at"
    )


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_is_noted_a_second_one_ends(number: signal.Signals) -> None:
    before = signal.getsignal(number)
    with Interrupts() as interrupts:
        assert not interrupts.noted
        signal.raise_signal(number)
        assert interrupts.noted
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(number)
    assert signal.getsignal(number) == before


def test_a_child_that_saving_needs_does_not_hear_sigterm() -> None:
    """A queue sent it to Ray's own processes too, and nothing of a training was saved."""
    words = [sys.executable, "-c", "input(); print('goes on')"]
    pipes: dict[str, Any] = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    with unheard_by_children():
        kept = subprocess.Popen(words, **pipes)
    other = subprocess.Popen(words, **pipes)
    for child in (kept, other):
        child.send_signal(signal.SIGTERM)
    assert kept.communicate("\n")[0] == "goes on\n"
    assert other.communicate()[0] == ""
    assert (kept.returncode, other.returncode) == (0, -signal.SIGTERM)
    assert not signal.pthread_sigmask(signal.SIG_BLOCK, ()) & {signal.SIGTERM, signal.SIGHUP}


def test_what_was_not_made_is_shown_by_tracebacks_that_show_variables() -> None:
    def shown(make: Callable[[], object]) -> str:
        try:
            make()
        except hurcules.Error as error:
            frames = [frame for frame, _ in traceback.walk_tb(error.__traceback__)]
            return repr(frames[2].f_locals["self"])
        raise AssertionError("nothing was refused")

    assert shown(lambda: hurcules.Simulation("no mission")) == "Simulation(not made)"
    simulation = hurcules.Simulation("lift", record=False)
    assert shown(lambda: hurcules.SimulationBatch(simulation, 0)) == "SimulationBatch(not made)"


def test_solutions_and_options_show_what_they_hold() -> None:
    solution = rhqp.Solver(2).solve([rhqp.Bounds(-np.ones(2), np.ones(2))])
    assert re.match(r"Solution\(.*status=Solved", repr(solution))
    assert "<table>" in solution._repr_html_() and "status" in solution._repr_html_()
    assert "method='lexicographic'" in repr(rhqp.SolverOptions())
    for shown in (
        hurcules.SimulationOptions(),
        hurcules.SensorOptions(),
        hurcules.MonitorOptions(),
        hurcules.DriveOptions(),
        hurcules.VelocityControllerOptions(dt=0.001),
        hurcules.AccelerationControllerOptions(dt=0.001),
    ):
        assert repr(shown).startswith(f"{type(shown).__name__}(")
        assert "object at 0x" not in repr(shown) and "=" in repr(shown)


def test_a_name_that_is_misspelt_is_answered_with_the_near_one() -> None:
    code = "import hurcules; hurcules.PositonTask"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "has no attribute 'PositonTask'. Did you mean: 'PositionTask'?" in done.stderr


@pytest.mark.parametrize("method", rhqp.method_names())
def test_the_solution_of_each_method_is_shown(method: str) -> None:
    solver = rhqp.Solver(2, rhqp.SolverOptions(method=method))
    solution = solver.solve([rhqp.Level(np.eye(2), np.ones(2), np.ones(2), rho=0.1)])
    assert "status=Solved" in repr(solution) and "status" in solution._repr_html_()
    assert (", levels=" in repr(solution)) == (method == "lexicographic")


def test_diagnostics_show_what_is_short_and_why() -> None:
    model = mujoco.MjModel.from_xml_string(
        '<mujoco><worldbody><body name="tip"><joint name="slide" type="slide" axis="1 0 0"'
        ' range="-1 1"/><geom size="0.1"/></body></worldbody><actuator>'
        '<motor joint="slide"/></actuator></mujoco>'
    )
    robot = hurcules.Robot(model)
    tip = hurcules.PositionTask("tip", robot, "tip", axes=[[1.0, 0.0, 0.0]])
    tip.set_target([3.0])
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([tip]))
    for _ in range(5000):
        controller.step(robot)
    assert "tip: 2 m short, held by slide upper limit" in str(controller.diagnostics(robot)[-1])


def test_without_the_extra_a_run_says_so_and_does_the_rest(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(extras, "missing", lambda: ["jinja2", "pillow"])
    assert cli.main(["run", "stretch", "--seconds", "0.1", "--out", str(tmp_path)]) == 0
    out = " ".join(capsys.readouterr().out.split())
    assert "jinja2, pillow are not installed; remedy: pip install 'hurcules[report]'" in out
    assert {path.name for path in tmp_path.iterdir()} == {"log.npz", "timing.npz", "summary.json"}


REPORT = ["matplotlib", "PIL", "jinja2", "imageio", "imageio_ffmpeg"]


def test_the_product_imports_without_the_extra() -> None:
    blocked = "import sys; sys.modules.update(dict.fromkeys(" + repr(REPORT) + ")); "
    code = blocked + "import hurcules, hurcules.cli, hurcules_studies.field_tests.command"
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize(
    ("module", "package", "remedy"),
    [
        ("hurcules_envs.sb3", "torch", "'hurcules[train]'"),
        ("hurcules_envs.training", "torch", "'hurcules[train]'"),
        ("hurcules_envs.rllib", "ray", "'ray[rllib]' torch"),
        ("hurcules.report", "jinja2", "'hurcules[report]'"),
        ("hurcules.report.seeds", "matplotlib", "'hurcules[report]'"),
    ],
)
def test_an_import_without_its_package_says_what_installs_it(
    module: str, package: str, remedy: str
) -> None:
    code = f"import sys, importlib; sys.modules[{package!r}] = None; import {module}"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    said = done.stderr.splitlines()[-1]
    assert said.startswith("ModuleNotFoundError: ") and package in said
    assert said.endswith(f"; remedy: pip install {remedy}")


def test_opengl_is_not_imported_before_the_first_picture() -> None:
    code = "import hurcules, sys; assert not {'OpenGL', 'glfw'} & set(sys.modules), sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_every_joint_and_level_has_words() -> None:
    for name in hurcules.models.names():
        for coordinate in hurcules.Robot(hurcules.models.load(name)).coordinate_names:
            assert legend.joint_words(coordinate) != coordinate, coordinate
    for level in hurcules.Simulation("stretch").levels:
        assert legend.level_words(level) != level, level
    active = ("HIP lower", "LSP upper", "RSP upper", "LEB lower")
    assert legend.limit_words(active) == ["hip lower", "shoulder pitch upper", "left elbow lower"]


def test_the_viewer_without_a_display_says_what_is_missing() -> None:
    code, _, err = call("view", DISPLAY="", WAYLAND_DISPLAY="")
    assert code == 2
    assert err.startswith("hurcules: error: the viewer needs a display") and err.count("\n") == 1


@pytest.mark.parametrize("name", ["stretch", "rescue", "stairs", "arm.xml"])
def test_the_viewer_shows_a_mission_a_robot_a_scene_and_a_file(tmp_path: Path, name: str) -> None:
    if not shutil.which("xvfb-run"):
        pytest.skip("no virtual display here; remedy: apt-get install xvfb xauth")
    ball = '<mujoco><worldbody><light pos="0 0 3"/><geom size="1"/></worldbody></mujoco>'
    (tmp_path / "arm.xml").write_text(ball)
    done = subprocess.run(
        ["xvfb-run", "-a", *COMMAND, "view", name, "--seconds", "1"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr


def test_no_object_shows_an_address() -> None:
    simulation = hurcules.Simulation("stretch", record=False)
    robot = hurcules.Robot(simulation.model)
    hand = hurcules.PositionTask("hand", robot, "L_wrist")
    assert repr(hurcules.Twist(hand, 0.3)) == "Channel(scale=[0.3], task=hand)"
    assert repr(hurcules.rhqp.Solver(3)) == "Solver(n=3)"
    batch = hurcules.SimulationBatch(simulation, n=2)
    assert repr(batch).startswith("SimulationBatch(2 of WholeBodyController(")
    assert repr(batch[0]).startswith("Simulation(time=0")
    for kind in vars(hurcules._core).values():
        assert not isinstance(kind, type) or kind.__repr__ is not object.__repr__, kind
