"""The version of this package, and the check that MuJoCo is the one it was built with.

Both numbers stand in pyproject.toml alone and come here with the metadata of the wheel.
"""

import importlib
import importlib.metadata
import os

__version__ = importlib.metadata.version("hurcules")


def wanted_mujoco() -> str:
    """Returns the version of MuJoCo that this package was built with."""
    pin = "mujoco=="
    requirements = importlib.metadata.requires("hurcules") or []
    return next(r.removeprefix(pin) for r in requirements if r.startswith(pin))


def require_mujoco() -> None:
    """Imports MuJoCo and compares its version with the wanted one.

    Our C++ code is linked to one exact libmujoco: another version has another layout in memory.

    Raises:
        ImportError: MuJoCo is missing, broken or another one; with what was wanted, what came,
            and the remedy.
    """
    wanted = wanted_mujoco()
    try:
        came = str(importlib.import_module("mujoco").__version__)
    except ModuleNotFoundError:
        came = "none"
    except Exception as error:  # its import opens OpenGL, which fails in many ways
        backend = os.environ.get("MUJOCO_GL", "")
        raise ImportError(
            f"MuJoCo cannot be imported with MUJOCO_GL={backend} ({error}); "
            "remedy: unset MUJOCO_GL, or set it to osmesa or disable"
        ) from error
    if came != wanted:
        raise ImportError(
            f"hurcules {__version__} needs MuJoCo {wanted}, installed is {came}; "
            f"remedy: pip install mujoco=={wanted}"
        )
