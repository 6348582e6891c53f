"""What a controller does, drawn for a robot that is written here.

Strategy: the marks against what a hand can reckon, their geoms counted in a scene without
OpenGL, and a picture where there is OpenGL. Not tested: what a person sees in the viewer.
"""

from __future__ import annotations

import base64
import re
import shutil
import subprocess
import sys
import threading
import zlib
from pathlib import Path

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import drawing, extras, rendering

ARM = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.005"/>
  <default><joint axis="0 1 0" damping="1"/><geom type="capsule" size="0.03"/></default>
  <worldbody>
    <light pos="0 0 3"/>
    <camera name="side" pos="0.3 -2 0.5" xyaxes="1 0 0 0 0 1"/>
    <body>{root}
      <geom fromto="0 0 0 0 0 -0.2"/>
      <body name="upper">
        <geom fromto="0 0 0 0.4 0 0"/>
        <joint name="shoulder" range="-1 1"/>
        <body pos="0.4 0 0">
          <geom fromto="0 0 0 0.3 0 0"/>
          <joint name="elbow" range="-1 1"/>
          <site name="hand" pos="0.3 0 0"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="shoulder"/><motor joint="elbow"/></actuator>
</mujoco>
"""


def loop(root: str = "", **options: object) -> hurcules.Simulation:
    """An arm whose hand is wanted where its elbow's limit does not let it come."""
    model = mujoco.MjModel.from_xml_string(ARM.format(root=root))
    robot = hurcules.Robot(model)
    hand = hurcules.PositionTask("hand", robot, "hand")
    pose = hurcules.PoseTask("pose", robot, "hand")
    controller = hurcules.WholeBodyController(robot, [hand, pose], {"hand": hurcules.Target(hand)})
    simulation = hurcules.Simulation(model=model, controller=controller, **options)  # type: ignore[arg-type]
    simulation.step(600, {"hand": [-0.2, 0.0, 0.3]})
    return simulation


def test_marks_say_where_points_are_and_shall_be() -> None:
    simulation = loop()
    hand, pose = drawing.error_marks(simulation)
    assert (hand.task, pose.task) == ("hand", "pose")
    np.testing.assert_allclose(hand.target, [-0.2, 0.0, 0.3])
    np.testing.assert_allclose(hand.position, simulation.controller.plan.position("hand"))
    np.testing.assert_allclose(pose.target, [0.7, 0.0, 0.0], atol=1e-12)
    assert hand.orientation is None
    assert pose.orientation is not None
    np.testing.assert_allclose(pose.orientation, np.eye(3), atol=1e-12)


def test_a_point_of_one_axis_is_led_along_it_alone() -> None:
    model = mujoco.MjModel.from_xml_string(ARM.format(root=""))
    robot = hurcules.Robot(model)
    height = hurcules.PositionTask("height", robot, "hand", axes=[[0.0, 0.0, 2.0]])
    height.set_target([0.4])
    np.testing.assert_allclose(height.world_target, [0.7, 0.0, 0.4], atol=1e-12)
    bend = hurcules.PositionTask("bend", robot, "hand", reference="upper")
    robot.set_configuration([0.5, 0.5])
    bend.update(robot)
    bend.set_target([0.1, 0.0, 0.0])
    along = robot.position("upper") + 0.1 * robot.orientation("upper")[:, 0]
    np.testing.assert_allclose(bend.world_target, along, atol=1e-12)


def test_a_joint_at_its_limit_is_marked_where_it_is() -> None:
    simulation = loop()
    held = {mark.text: mark.position for mark in drawing.limit_marks(simulation)}
    assert "elbow lower limit" in held
    np.testing.assert_allclose(held["elbow lower limit"], simulation.data.joint("elbow").xanchor)
    assert drawing.limit_marks(hurcules.Simulation("stretch", record=False)) == []


def test_marks_go_with_a_robot_that_has_moved_from_its_plan() -> None:
    simulation = loop(root="<freejoint/>", physics=False)
    there = drawing.error_marks(simulation)[0].target
    simulation.data.qpos[:3] += [1.0, 2.0, 0.0]
    simulation.data.qpos[3:7] = [np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)]  # a quarter turn about z
    moved = drawing.error_marks(simulation)[0].target
    np.testing.assert_allclose(moved, [1.0 - there[1], 2.0 + there[0], there[2]], atol=1e-9)


def test_each_mark_is_a_geom_until_the_scene_is_full() -> None:
    simulation = loop()
    scene = mujoco.MjvScene(simulation.model, maxgeom=20)
    drawing.draw(scene, simulation)
    errors, limits = drawing.error_marks(simulation), drawing.limit_marks(simulation)
    # a line and a ball each, three axes of the pose
    assert scene.ngeom == 2 * len(errors) + 3 + len(limits)
    labels = [scene.geoms[i].label for i in range(scene.ngeom)]
    away = 1e3 * np.linalg.norm(errors[0].position - errors[0].target)
    assert f"hand: {away:.0f} mm" in labels
    full = mujoco.MjvScene(simulation.model, maxgeom=3)
    drawing.draw(full, simulation)
    assert full.ngeom == 3


def has_renderer() -> bool:
    try:
        rendering.make_renderer(loop().model, 16, 16).close()
    except rendering.RendererError:
        return False
    return True


def test_a_picture_names_the_joints_at_their_limits_at_its_top_left() -> None:
    if not has_renderer():
        pytest.skip(f"no OpenGL here; remedy: {rendering.REMEDY}")
    simulation = loop()
    assert "elbow lower limit" in drawing.caption(simulation).splitlines()
    named = simulation.picture(320, 240, "side").astype(int)
    free = loop()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(drawing, "caption", lambda loop: "")
        bare = free.picture(320, 240, "side").astype(int)
    changed = np.argwhere(np.abs(named - bare).max(axis=2) > 8)
    assert len(changed) > 100
    assert changed[:, 0].max() < 80 and changed[:, 1].max() < 200


def test_a_picture_shows_the_target() -> None:
    if not has_renderer():
        pytest.skip(f"no OpenGL here; remedy: {rendering.REMEDY}")
    simulation = loop()
    shown = simulation.picture(320, 240, "side").astype(int)
    assert shown.shape == (240, 320, 3)
    green = (shown[..., 1] > 1.5 * shown[..., 0]) & (shown[..., 1] > 1.5 * shown[..., 2])
    red = (shown[..., 0] > 2 * shown[..., 1]) & (shown[..., 0] > 2 * shown[..., 2])
    assert green.sum() > 10 and red.sum() > 10
    assert np.array_equal(simulation.picture(320, 240, "side"), shown)
    assert simulation.picture(64, 48).shape == (48, 64, 3)
    again = []
    thread = threading.Thread(target=lambda: again.append(simulation.picture(320, 240, "side")))
    thread.start()
    thread.join()
    assert np.array_equal(again, [shown])  # each thread has a renderer of its own
    with pytest.raises(hurcules.Error, match="camera 'top' does not exist; there are: side"):
        simulation.picture(camera="top")
    assert np.array_equal(simulation.picture(320, 240, 0), shown)
    with pytest.raises(hurcules.Error, match="camera 1: the model has 1, counted from 0: side"):
        simulation.picture(camera=1)
    for size in ((0, 48), (64, 10**5), (64.5, 48)):
        with pytest.raises(hurcules.Error, match="whole numbers from 1 to 16384, got"):
            simulation.picture(*size)  # type: ignore[arg-type]
    assert simulation.picture(64, 48).shape == (48, 64, 3)  # nor is the model's buffer enlarged


@pytest.mark.parametrize("way", [0.0, 0.2, 6.0])
def test_the_camera_goes_after_a_robot_that_drives_away(way: float) -> None:
    base = '<joint name="x" type="slide" axis="1 0 0"/>'
    text = ARM.format(root=base).replace("<actuator>", '<actuator><motor joint="x"/>')
    model = mujoco.MjModel.from_xml_string(text)
    robot = hurcules.Robot(model)
    robot.set_configuration([way, 0.0, 0.0])
    controller = hurcules.WholeBodyController(robot, [hurcules.PostureTask("posture", robot)])
    simulation = hurcules.Simulation(model=model, controller=controller, physics=False)
    still = mujoco.MjvCamera()
    mujoco.mjv_defaultFreeCamera(model, still)
    margin = 0.5 * float(model.stat.extent)
    wanted = still.lookat + np.array([max(0.0, way - margin), 0.0, 0.0])
    np.testing.assert_allclose(drawing.overview(simulation).lookat, wanted, atol=1e-9)
    if way < margin and has_renderer():
        assert np.array_equal(simulation.picture(80, 60), simulation.picture(80, 60, still))


# imageio's reader, not its writer, leaves pipes open
@pytest.mark.filterwarnings(
    "ignore:unclosed file", "ignore::pytest.PytestUnraisableExceptionWarning"
)
def test_a_film_shows_each_moment_and_asks_for_each_command(tmp_path: Path) -> None:
    if not has_renderer():
        pytest.skip(f"no OpenGL here; remedy: {rendering.REMEDY}")
    imageio = pytest.importorskip("imageio.v2")
    simulation = loop()
    begun, asked, path = simulation.time, [], tmp_path / "new" / "arm.mp4"

    def command(asking: hurcules.Simulation) -> dict[str, list[float]]:
        asked.append(asking.time - begun)
        return {"hand": [0.6, 0.0, 0.1]}

    shown = hurcules.film(
        simulation, path, 1.2, command, camera="side", width=160, height=128, fps=10
    )
    assert shown == 12 and simulation.time == pytest.approx(begun + 1.2)
    assert asked == pytest.approx(np.arange(12) / 10, abs=1e-9)
    with imageio.get_reader(path) as reader:
        pictures = [np.asarray(picture).astype(int) for picture in reader]
    assert len(pictures) == 12 and pictures[0].shape == (128, 160, 3)
    assert np.abs(pictures[0] - pictures[-1]).max() > 100  # the arm has moved
    with pytest.raises(hurcules.Error, match="channel 'hnad' does not exist"):
        hurcules.film(simulation, path, 1.0, {"hnad": [0.0, 0.0, 0.0]}, width=160, height=128)


@pytest.mark.parametrize(
    ("name", "options", "words"),
    [
        ("arm.mp4", {"seconds": 1.0, "width": 100}, "multiples of 16, got 100 and 480"),
        ("arm.mp4", {"seconds": 0.0}, "numbers above 0, got 0.0 and 25"),
        ("arm.mp4", {"seconds": float("nan")}, "numbers above 0, got nan and 25"),
        ("arm.gif", {"seconds": 1.0}, "ends in .mp4, got '.*arm.gif'"),
    ],
)
def test_a_film_says_what_it_wants(
    tmp_path: Path, name: str, options: dict[str, float], words: str
) -> None:
    simulation = loop()
    with pytest.raises(hurcules.Error, match=words):
        hurcules.film(simulation, tmp_path / name, **options)
    assert not list(tmp_path.iterdir())


def test_a_film_without_the_extra_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(extras, "missing", lambda: ["imageio"])
    with pytest.raises(hurcules.Error, match=r"imageio is not installed; remedy: pip install 'hur"):
        hurcules.film(loop(), tmp_path / "arm.mp4", 1.0)


def test_pictures_of_one_size_are_drawn_by_one_renderer(monkeypatch: pytest.MonkeyPatch) -> None:
    """Made anew for each, they took 2 to 4 times as long."""
    if not has_renderer():
        pytest.skip(f"no OpenGL here; remedy: {rendering.REMEDY}")
    made = []

    def make(*given):
        made.append(given)
        return rendering.make_renderer(*given)

    monkeypatch.setattr(drawing, "make_renderer", make)
    for simulation in (loop(), loop()):
        first = simulation.picture(80, 60)
        simulation.step(300, {"hand": [0.0, 0.0, 0.3]})
        assert not np.array_equal(simulation.picture(80, 60), first)
    assert len(made) == 2  # one a model


def test_a_notebook_shows_levels_limits_and_a_picture(monkeypatch: pytest.MonkeyPatch) -> None:
    simulation = loop()
    text = simulation._repr_html_()
    assert "error of hand [m, rad]" in text and "elbow lower limit" in text and "3.000 s" in text
    if has_renderer():
        found = re.search("base64,([^']+)'", text)
        assert found is not None
        file = base64.b64decode(found[1])
        assert file.startswith(b"\x89PNG\r\n\x1a\n")
        data = file[file.index(b"IDAT") + 4 : file.index(b"IEND") - 8]
        assert len(zlib.decompress(data)) == 480 * (1 + 3 * 640)

    def fail(*_: object) -> None:
        raise rendering.RendererError("no usable renderer <here>")

    monkeypatch.setattr(drawing, "picture", fail)
    assert "no usable renderer &lt;here&gt;" in simulation._repr_html_()


def in_a_window(tmp_path: Path, program: str) -> subprocess.CompletedProcess[str]:
    """How a program ends that shows `loop()` on a virtual display."""
    if not shutil.which("xvfb-run"):
        pytest.skip("no virtual display here; remedy: apt-get install xvfb xauth")
    path = tmp_path / "watch.py"
    path.write_text(
        f"import sys; sys.path.insert(0, {str(Path(__file__).parent)!r})\n"
        "import hurcules, test_drawing\n"
        "simulation = test_drawing.loop()\n" + program
    )
    return subprocess.run(
        ["xvfb-run", "-a", sys.executable, str(path)],
        capture_output=True,
        text=True,
        timeout=300,
    )


def test_the_viewer_watches_a_simulation_of_any_robot(tmp_path: Path) -> None:
    done = in_a_window(
        tmp_path,
        "begun, asked = simulation.time, []\n"
        "def command(simulation):\n"
        "    asked.append(simulation.time)\n"
        "    return {'hand': [0.6, 0.0, 0.1]}\n"
        "hurcules.watch(simulation, command, seconds=2.0)\n"
        "assert simulation.time > begun and asked, (simulation.time, asked)\n",
    )
    assert done.returncode == 0, done.stderr


def test_a_mistake_while_a_window_is_open_ends_with_its_error(tmp_path: Path) -> None:
    """It ended the process, or never ended: the window still drew."""
    program = "hurcules.watch(hurcules.Simulation('stretch'), {'hnad': [0.0, 0.0, 0.0]})\n"
    done = in_a_window(tmp_path, program)
    assert (done.returncode, "channel 'hnad' does not exist" in done.stderr) == (1, True), done


def test_an_environment_in_a_window_keeps_time_and_closes(tmp_path: Path) -> None:
    done = in_a_window(
        tmp_path,
        "import gymnasium, hurcules_envs, numpy, time\n"
        "env = gymnasium.make('Hurcules/Reach-v0', fidelity='kinematic', render_mode='human')\n"
        "env.reset(seed=0)\n"
        "env.step(numpy.zeros(6))\n"
        "begun = time.perf_counter()\n"
        "for _ in range(20): env.step(numpy.zeros(6))\n"
        "took = time.perf_counter() - begun\n"
        "env.close()\n"
        "assert took >= 0.95, took\n",  # 20 steps of 50 ms
    )
    assert done.returncode == 0, done.stderr


def test_a_window_that_is_still_open_does_not_crash_the_end(tmp_path: Path) -> None:
    done = in_a_window(
        tmp_path,
        "from hurcules.view import opened\n"
        "window = opened(simulation.model, simulation.data)\n"
        "window.__enter__().sync()\n",
    )
    assert done.returncode == 0, done.stderr


def test_without_a_display_watch_says_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    with pytest.raises(hurcules.Error, match=r"a display.*simulation\.picture\(\).*rgb_array"):
        hurcules.watch(loop())
    with pytest.raises(hurcules.Error, match=r"watch: wanted .* got 'stretch'"):
        hurcules.watch("stretch")
