"""A mission, robot, scene or MJCF file in MuJoCo's own viewer, in real time, or as a film."""

from __future__ import annotations

import atexit
import os
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import mujoco

from hurcules import models
from hurcules._core import Error, Plant
from hurcules.drawing import Picture, caption, draw
from hurcules.extras import without
from hurcules.output import writing
from hurcules.own_simulation import is_own, make
from hurcules.simulation import Command, Simulation, missions
from hurcules.validation import require_known
from hurcules.video import encode

__all__ = ["film", "opened", "require_display", "view", "watch"]

FPS = 60  # pictures a second
_MODELS = (".xml", ".mjb", ".urdf")


def view(
    name: str,
    seed: int = 0,
    seconds: float | None = None,
    parameters: Mapping[str, Any] | None = None,
) -> None:
    """Opens the viewer and simulates until its window is closed.

    Args:
        name: one of `hurcules.missions()`, `models.names()` or `models.scenes()`, the TOML file of
            a mission, a file of MJCF, MJB or URDF, or of Python as for `hurcules run`. A robot of
            ours has its brakes on; a model of a file moves as MuJoCo has it.
        seed: of the mission.
        seconds: close the window after this time [s].
        parameters: of the mission, by name.

    Raises:
        Error: nothing has this name, a file is no model, or there is no display.
    """
    if is_own(name):
        watch(make(name, seed, parameters), seconds=seconds)
    elif name in missions() or name.endswith(".toml"):
        watch(Simulation(name, seed, record=False, parameters=parameters), seconds=seconds)
    else:
        _show(*_subject(name), lambda scene: "", seconds)


def watch(
    simulation: Simulation,
    command: Command | Callable[[Simulation], Command | None] | None = None,
    seconds: float | None = None,
) -> None:
    """Shows a simulation in MuJoCo's viewer, in real time, until its window is closed.

    What its controller does is drawn: targets, the ways to them, joints at their limits.

    Args:
        simulation: goes on from where it is, as long as it is not finished.
        command: as for `Simulation.step`, or a function of the simulation that gives one.
        seconds: close the window after this time [s].

    Raises:
        Error: there is no display, or a command that `Simulation.step` refuses.
    """
    if not isinstance(simulation, Simulation):
        raise Error(
            f"watch: wanted a hurcules.Simulation, got {simulation!r}; an environment is shown by "
            "render_mode='human'"
        )

    def advance(n: int) -> None:
        now = command(simulation) if callable(command) else command
        ticks = round(n * simulation.model.opt.timestep / simulation.dt)
        if ticks and not simulation.finished:
            simulation.step(ticks, now)

    def mark(scene: mujoco.MjvScene) -> str:
        scene.ngeom = 0
        draw(scene, simulation)
        return caption(simulation)

    _show(simulation.model, simulation.data, advance, mark, seconds)


def film(
    simulation: Simulation,
    path: str | Path,
    seconds: float,
    command: Command | Callable[[Simulation], Command | None] | None = None,
    *,
    camera: str | int | mujoco.MjvCamera | None = None,
    width: int = 640,
    height: int = 480,
    fps: int = 25,
) -> int:
    """Simulates, and writes what it looks like as a film at the pace of the physics.

    What its controller does is drawn, as by `watch`.

    Args:
        simulation: goes on from where it is, until it is finished at most.
        path: the file, .mp4; its folder is made.
        seconds: how long [s].
        command: as for `Simulation.step`, or a function of the simulation that gives one for each
            picture.
        camera: as for `Simulation.picture`.
        width: [pixels], a multiple of 16.
        height: [pixels], a multiple of 16.
        fps: [1/s] pictures a second.

    Returns:
        The number of pictures.

    Raises:
        RendererError: there is no OpenGL that works.
        Error: the model has no such camera, a file of another kind, a size that is no multiple of
            16, a command that `Simulation.step` refuses, or no extra hurcules[report].
        WriteError: the folder cannot be made.
        OSError: the file cannot be written.
    """
    if width % 16 or height % 16 or min(width, height) < 16:
        raise Error(f"film: width and height want multiples of 16, got {width} and {height}")
    if not (seconds > 0.0 and fps > 0):
        raise Error(f"film: seconds and fps want numbers above 0, got {seconds} and {fps}")
    if Path(path).suffix != ".mp4":
        raise Error(f"film wants a file that ends in .mp4, got {str(path)!r}")
    if lost := without():
        raise Error(f"film: {lost}")
    begun = simulation.time

    def steps() -> Iterator[Picture]:
        for i in range(round(seconds * fps)):
            yield simulation.picture(width, height, camera)
            if simulation.finished:
                return
            until = begun + (i + 1) / fps
            now = command(simulation) if callable(command) else command
            simulation.step(max(0, round((until - simulation.time) / simulation.dt)), now)

    with writing(path := Path(path)):
        path.parent.mkdir(parents=True, exist_ok=True)
    return encode(path, steps(), fps)


def _show(
    model: Any,
    data: Any,
    advance: Callable[[int], Any],
    mark: Callable[[Any], str],
    seconds: float | None,
) -> None:
    """Opens the window.

    `advance` takes steps of the physics, `mark` draws into the window's own scene and says what
    stands at its top left.
    """
    with opened(model, data, show_left_ui=False) as window:
        started, begun = time.perf_counter(), data.time
        while window.is_running():
            passed = time.perf_counter() - started
            if seconds is not None and passed >= seconds:
                break
            with window.lock():
                # a machine that is too slow shows slow motion, not ever longer leaps
                until = min(begun + passed, data.time + 2.0 / FPS)
                advance(round((until - data.time) / model.opt.timestep))
                text = mark(window.user_scn)
            window.set_texts((None, None, text, None))
            window.sync()
            time.sleep(max(0.0, 1.0 / FPS - (time.perf_counter() - started - passed)))


@contextmanager
def opened(model: Any, data: Any, **shown: Any) -> Iterator[Any]:
    """MuJoCo's passive viewer; its thread has ended when this is left, or the program ends.

    Args:
        model: of what is shown.
        data: of it.
        shown: as `mujoco.viewer.launch_passive` takes it.

    Raises:
        Error: there is no display.
    """
    require_display()
    import mujoco.viewer

    threads = set(threading.enumerate())
    window = mujoco.viewer.launch_passive(model, data, **shown)
    drawing = set(threading.enumerate()) - threads

    def close() -> None:
        window.close()
        for thread in drawing:
            thread.join()  # it still draws this model

    atexit.register(close)
    try:
        yield window
    finally:
        close()
        atexit.unregister(close)


def _subject(name: str) -> tuple[Any, Any, Callable[[int], Any]]:
    """Model, state, and what takes so many steps."""
    path = Path(name)
    if path.suffix in _MODELS:
        model = _read(path)
        data = mujoco.MjData(model)
        return model, data, lambda n: mujoco.mj_step(model, data, n)
    names = list(dict.fromkeys([*missions(), *models.names(), *models.scenes()]))
    if path.is_file() and name not in names:
        endings = ", ".join((*_MODELS, ".toml", ".py"))
        raise Error(f"{path}: wanted a file that ends in one of {endings}")
    require_known("mission, model, scene or file", name, names)
    model = models.load(name) if name in models.names() else models.load(scene=name)
    data = mujoco.MjData(model)
    plant = Plant(model, data)
    plant.reset("drive")
    plant.brakes.reset(True)
    for belt in (joint for joint in plant.brakes.names if joint.endswith("_belt")):
        plant.brakes.set_closed(belt, False)
    return model, data, lambda n: plant.step(n) if n else None


def _read(path: Path) -> Any:
    if not path.is_file():
        raise Error(f"{path}: no such file")
    try:
        if path.suffix == ".mjb":
            return mujoco.MjModel.from_binary_path(str(path))
        return mujoco.MjModel.from_xml_path(str(path))
    except ValueError as error:
        raise Error(f"MuJoCo rejects {path}: {' '.join(str(error).split())}") from error


def require_display() -> None:
    """Raises Error, with the remedy, where no window can be opened (GLFW would end the process)."""
    has_display = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    if sys.platform == "linux" and not has_display:
        raise Error(
            "the viewer needs a display, and neither DISPLAY nor WAYLAND_DISPLAY is set; remedy: "
            "run it at a desktop or with ssh -X; without a display, hurcules run films a mission, "
            "simulation.picture() and hurcules.film(simulation, ...) draw one of your own, and "
            "render_mode='rgb_array' an environment"
        )
    import glfw

    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        if glfw.init():
            return
    reason = str(said[-1].message) if said else "GLFW does not start"
    raise Error(f"the viewer cannot open a window: {reason}")
