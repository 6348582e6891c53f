"""MuJoCo's OpenGL: imported with the first picture, not with MuJoCo, and chosen where nobody has.

MuJoCo reads the environment variable MUJOCO_GL at its import, loads that OpenGL, and fails where it
is not there. `import_mujoco` imports MuJoCo without; its renderers then load OpenGL when they open.
Where somebody imported MuJoCo before us, `give_mujoco` brings its choice up to date.
"""

import ctypes
import importlib
import os
import sys
from collections.abc import MutableMapping
from pathlib import Path
from typing import Any

__all__ = ["REMEDY", "choose_backend", "give_mujoco", "import_mujoco", "lacking"]

REMEDY = (
    "apt-get install libosmesa6 (or libegl1 libegl-mesa0 libgl1-mesa-dri libopengl0), "
    "or set MUJOCO_GL to the one of egl, osmesa, glfw that works on this machine"
)

# one library of each group must load; without OpenGL beside EGL the import of MuJoCo itself fails
_LIBRARIES: dict[str, list[tuple[str, ...]]] = {
    "osmesa": [("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so")],
    "egl": [("libEGL.so.1", "libEGL.so"), ("libOpenGL.so.0", "libGL.so.1")],
}
_DISABLED = ("disable", "disabled", "off", "false", "0")


def choose_backend(environment: MutableMapping[str, str] = os.environ) -> str:
    """Sets MUJOCO_GL on a Linux machine without a display, unless somebody has set it.

    PYOPENGL_PLATFORM, where it is set, leaves PyOpenGL no other. Else with a graphics device EGL
    comes first, without one OSMesa: the faster one each time.

    Args:
        environment: where MUJOCO_GL, PYOPENGL_PLATFORM, DISPLAY and WAYLAND_DISPLAY are read, and
            MUJOCO_GL is set.

    Returns:
        The value of MUJOCO_GL afterwards, "" when MuJoCo's own choice is left alone.
    """
    if sys.platform == "linux" and not _has_display(environment) and "MUJOCO_GL" not in environment:
        device = any(Path("/dev").glob("nvidia[0-9]*")) or any(Path("/dev/dri").glob("render*"))
        bound = environment.get("PYOPENGL_PLATFORM", "").lower()
        for backend in ("egl", "osmesa") if device else ("osmesa", "egl"):
            if bound in ("", backend) and not lacking(backend):
                environment["MUJOCO_GL"] = backend
                break
    return environment.get("MUJOCO_GL", "")


def _has_display(environment: MutableMapping[str, str]) -> bool:
    return bool(environment.get("DISPLAY") or environment.get("WAYLAND_DISPLAY"))


def import_mujoco() -> Any:
    """Imports MuJoCo without its OpenGL, which comes with the first renderer.

    Returns:
        The module; as it is, where somebody has imported it before.
    """
    if sys.modules.get("mujoco") is not None:
        return sys.modules["mujoco"]
    chosen = os.environ.get("MUJOCO_GL")
    os.environ["MUJOCO_GL"] = "disable"
    try:
        mujoco = importlib.import_module("mujoco")
    finally:
        if chosen is None:
            del os.environ["MUJOCO_GL"]
        else:
            os.environ["MUJOCO_GL"] = chosen
    if (chosen or "").lower() not in _DISABLED:
        try:
            context: Any = importlib.import_module("mujoco.rendering.classic.gl_context")
        except ImportError:  # another MuJoCo, which is for others to complain about
            return mujoco
        context.GLContext = mujoco.GLContext = _first_context  # type: ignore[attr-defined]
    return mujoco


def _first_context(width: int, height: int) -> Any:
    """Makes MuJoCo's OpenGL context for so many pixels, after its class has been imported."""
    backend = choose_backend()
    if backend not in ("", "egl", "glfw", "glx", "osmesa"):
        raise RuntimeError(f"invalid value for environment variable MUJOCO_GL: {backend}")
    if not backend and sys.platform == "linux" and not _has_display(os.environ):
        raise RuntimeError("no display, and neither OSMesa nor EGL on this machine")
    give_mujoco(backend if backend in _LIBRARIES else "glfw")
    context: Any = sys.modules["mujoco.rendering.classic.gl_context"]
    return context.GLContext(width, height)


def give_mujoco(backend: str) -> None:
    """Lets MuJoCo's renderers use this OpenGL from now on, whatever it chose at its import.

    Args:
        backend: "egl", "osmesa" or "glfw"; all else leaves MuJoCo's choice alone.

    Raises:
        Exception: of many kinds, when the OpenGL is not there.
    """
    if backend in (*_LIBRARIES, "glfw"):
        chosen: Any = importlib.import_module("mujoco.rendering.classic.gl_context")
        chosen.GLContext = importlib.import_module(f"mujoco.{backend}").GLContext


def lacking(backend: str) -> list[str]:
    """The shared libraries that a backend wants and that are not on this machine."""
    groups = _LIBRARIES.get(backend, [])
    return [group[0] for group in groups if not any(_loads(name) for name in group)]


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True
