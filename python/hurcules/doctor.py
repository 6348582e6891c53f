"""What this machine has and lacks, with the remedy: the rows of `hurcules doctor`."""

import os
import platform
import subprocess
import sys
from dataclasses import dataclass
from typing import Literal

from hurcules import _core, models
from hurcules._version import __version__, wanted_mujoco
from hurcules.opengl import REMEDY as RENDERER_REMEDY

__all__ = ["Finding", "Status", "examine", "render_with"]

Status = Literal["ok", "lacks", "broken"]  # "lacks": something optional is missing

_RENDER = """
import mujoco
import mujoco.gl_context  # MuJoCo hides why this fails
ball = '<mujoco><worldbody><light pos="0 0 3"/><geom size="1"/></worldbody></mujoco>'
model = mujoco.MjModel.from_xml_string(ball)
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
with mujoco.Renderer(model, 48, 64) as renderer:
    renderer.update_scene(data)
    assert renderer.render().max() > 0, "the picture is black"
"""


@dataclass(frozen=True)
class Finding:
    """One row: what was looked at, how it stands, what was found, and what helps."""

    what: str
    status: Status
    detail: str
    remedy: str = ""


def examine() -> list[Finding]:
    """Looks at everything; takes seconds, because each picture is drawn by a process of its own."""
    return [_python(), _mujoco(), _module(), _models(), _cores(), _renderer(), _codec()]


def render_with(backend: str) -> str:
    """Draws a small picture in a process of its own, since a broken OpenGL can end the process.

    Args:
        backend: a value of MUJOCO_GL: "egl", "osmesa" or "glfw".

    Returns:
        "" when it worked, else the last line of what went wrong.
    """
    # MuJoCo's import has left the choice of this process there
    environment = {k: v for k, v in os.environ.items() if k != "PYOPENGL_PLATFORM"}
    try:
        attempt = subprocess.run(
            [sys.executable, "-c", _RENDER],
            env={**environment, "MUJOCO_GL": backend},
            capture_output=True,
            text=True,
            timeout=60,
        )
    except subprocess.TimeoutExpired:
        return "no picture within 60 s"
    if attempt.returncode == 0:
        return ""
    lines = [line for line in attempt.stderr.splitlines() if "Error" in line]
    return lines[-1].strip() if lines else f"exit status {attempt.returncode}"


def _python() -> Finding:
    return Finding("Python", "ok", f"{platform.python_version()} at {sys.executable}")


def _mujoco() -> Finding:
    detail = f"{_core.build['mujoco']}, as pinned"
    if _core.build["mujoco"] == wanted_mujoco():
        return Finding("MuJoCo", "ok", detail)
    remedy = f"pip install mujoco=={wanted_mujoco()}"
    return Finding("MuJoCo", "broken", f"{_core.build['mujoco']}, wanted {wanted_mujoco()}", remedy)


def _module() -> Finding:
    build = _core.build
    asserts = "with" if build["asserts"] else "without"
    detail = (
        f"{build['version']}, {build['build_type']} by {build['compiler']}, "
        f"flags {str(build['flags']).strip()}, {asserts} asserts, SIMD {build['simd']}, "
        f"Eigen {build['eigen']}"
    )
    if build["version"] != __version__:
        return Finding(
            "hurcules._core", "broken", f"{detail}; the package is {__version__}", "pip install ."
        )
    if build["build_type"] != "Release":
        return Finding("hurcules._core", "lacks", detail, "a Release build, for the speed")
    return Finding("hurcules._core", "ok", detail)


def _models() -> Finding:
    robots = models.names()
    if not robots:
        return Finding("models", "broken", f"none in {models.folder()}", "pip install .")
    return Finding("models", "ok", f"{', '.join(robots)} in {models.folder()}")


def _cores() -> Finding:
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return Finding("processor", "ok", f"{cores} cores, {platform.machine()}")


def _renderer() -> Finding:
    """The one that MUJOCO_GL names must draw; without a name, any."""
    chosen = os.environ.get("MUJOCO_GL", "")
    backends = dict.fromkeys(["egl", "osmesa", chosen or "egl"])
    faults = {backend: render_with(backend) for backend in backends}
    detail = ", ".join(f"{backend}: {fault or 'draws'}" for backend, fault in faults.items())
    if faults[chosen] == "" if chosen else "" in faults.values():
        return Finding("renderer", "ok", f"{detail}; MUJOCO_GL={chosen}" if chosen else detail)
    return Finding("renderer", "lacks", detail, RENDERER_REMEDY)


def _codec() -> Finding:
    remedy = "pip install imageio-ffmpeg"
    try:
        import imageio_ffmpeg

        program = imageio_ffmpeg.get_ffmpeg_exe()
        encoders = subprocess.run([program, "-encoders"], capture_output=True, text=True).stdout
    except (ImportError, RuntimeError, OSError) as error:
        return Finding("video codec", "lacks", str(error), remedy)
    if "libx264" not in encoders:
        return Finding("video codec", "lacks", f"{program} has no libx264", remedy)
    return Finding("video codec", "ok", f"libx264 by {program}")
