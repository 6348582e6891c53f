"""What this machine has and lacks, with the remedy: the rows of `hurcules doctor`.

This module imports where MuJoCo or our own compiled module cannot be: that is when it is needed.
"""

import importlib
import importlib.metadata
import os
import platform
import subprocess
import sys
from dataclasses import dataclass
from typing import Any, Literal

from hurcules import extras
from hurcules.opengl import REMEDY as RENDERER_REMEDY
from hurcules.opengl import import_mujoco, lacking

__all__ = ["Finding", "Status", "examine", "render_with", "report"]

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
    looks = (_python, _mujoco, _module, _models, _cores, _renderer, _extras, _codec)
    return [finding for look in looks for finding in look()]


def report() -> int:
    """Prints the findings as plain text; returns 1 when something is broken, else 0."""
    findings = examine()
    for finding in findings:
        print(f"{finding.what:16} {finding.status:7} {finding.detail}")
        if finding.remedy:
            print(f"{'':24} remedy: {finding.remedy}")
    return int(any(finding.status == "broken" for finding in findings))


def render_with(backend: str) -> str:
    """Draws a small picture in a process of its own, since a broken OpenGL can end the process.

    Args:
        backend: a value of MUJOCO_GL: "egl", "osmesa" or "glfw".

    Returns:
        "" when it worked, else the last line of what went wrong.
    """
    if lost := lacking(backend):
        return f"no {' and no '.join(lost)}"
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


def _python() -> list[Finding]:
    return [Finding("Python", "ok", f"{platform.python_version()} at {sys.executable}")]


def _mujoco() -> list[Finding]:
    wanted = _pin()
    remedy = f"pip install --force-reinstall mujoco=={wanted}"
    try:
        came = str(import_mujoco().__version__)
    except Exception as error:  # an import fails in many ways
        text = f"cannot be imported: {type(error).__name__}: {error}"
        return [Finding("MuJoCo", "broken", text, remedy)]
    if came != wanted:
        return [Finding("MuJoCo", "broken", f"{came}, wanted {wanted}", remedy)]
    return [Finding("MuJoCo", "ok", f"{came}, as pinned")]


def _pin() -> str:
    """The version of MuJoCo that the package requires."""
    try:
        requirements = importlib.metadata.requires("hurcules") or []
    except importlib.metadata.PackageNotFoundError:
        requirements = []
    pins = [text.removeprefix("mujoco==") for text in requirements if text.startswith("mujoco==")]
    return pins[0] if pins else ""


def _module() -> list[Finding]:
    remedy = "pip install ."
    try:
        core: Any = importlib.import_module("hurcules._core")
        version = importlib.metadata.version("hurcules")
    except Exception as error:
        return [Finding("hurcules._core", "broken", f"{type(error).__name__}: {error}", remedy)]
    build = core.build
    asserts = "with" if build["asserts"] else "without"
    detail = (
        f"{build['version']}, {build['build_type']} by {build['compiler']}, "
        f"flags {str(build['flags']).strip()}, {asserts} asserts, SIMD {build['simd']}, "
        f"Eigen {build['eigen']}"
    )
    if build["version"] != version:
        detail += f"; the package is {version}"
        return [Finding("hurcules._core", "broken", detail, remedy)]
    if build["mujoco"] != _pin():
        detail += f"; built with MuJoCo {build['mujoco']}, wanted {_pin()}"
        return [Finding("hurcules._core", "broken", detail, remedy)]
    if build["build_type"] != "Release":
        return [Finding("hurcules._core", "lacks", detail, "a Release build, for the speed")]
    return [Finding("hurcules._core", "ok", detail)]


def _models() -> list[Finding]:
    try:
        models: Any = importlib.import_module("hurcules.models")
    except Exception as error:
        return [Finding("models", "broken", f"{type(error).__name__}: {error}", "see above")]
    robots = models.names()
    if not robots:
        return [Finding("models", "broken", f"none in {models.folder()}", "pip install .")]
    return [Finding("models", "ok", f"{', '.join(robots)} in {models.folder()}")]


def _cores() -> list[Finding]:
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return [Finding("processor", "ok", f"{cores} cores, {platform.machine()}")]


def _renderer() -> list[Finding]:
    """The one that MUJOCO_GL names must draw; without a name, any."""
    chosen = os.environ.get("MUJOCO_GL", "")
    backends = dict.fromkeys(["egl", "osmesa", chosen or "egl"])
    faults = {backend: render_with(backend) for backend in backends}
    detail = ", ".join(f"{backend}: {fault or 'draws'}" for backend, fault in faults.items())
    if chosen:
        detail += f"; MUJOCO_GL={chosen}"
    if faults[chosen] == "" if chosen else "" in faults.values():
        return [Finding("renderer", "ok", detail)]
    remedy = "unset MUJOCO_GL" if chosen and "" in faults.values() else RENDERER_REMEDY
    return [Finding("renderer", "lacks", detail, remedy)]


def _extras() -> list[Finding]:
    """What is needed for films, training and more, each an extra of the package."""
    found = []
    for extra in extras.names():
        what = extras.FOR.get(extra, extra)
        if lost := extras.missing(extra):
            text = f"no {', '.join(lost)}"
            found.append(Finding(what, "lacks", text, extras.remedy(extra)))
        else:
            found.append(Finding(what, "ok", ", ".join(extras.packages(extra))))
    return found


def _codec() -> list[Finding]:
    if "imageio-ffmpeg" in extras.missing():
        return []
    try:
        import imageio_ffmpeg

        program = imageio_ffmpeg.get_ffmpeg_exe()
        encoders = subprocess.run([program, "-encoders"], capture_output=True, text=True).stdout
    except (ImportError, RuntimeError, OSError) as error:
        return [Finding("video codec", "lacks", str(error), extras.remedy())]
    if "libx264" not in encoders:
        return [Finding("video codec", "lacks", f"{program} has no libx264", extras.remedy())]
    return [Finding("video codec", "ok", f"libx264 by {program}")]
