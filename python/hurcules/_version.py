"""The version of this package, and the check that MuJoCo is the one it was built with.

Both numbers stand in pyproject.toml alone and come here with the metadata of the wheel.
"""

import importlib.metadata
from pathlib import Path

from hurcules.opengl import import_mujoco

_SOURCES = Path(__file__).resolve().parents[2] / "pyproject.toml"  # in a checkout alone
NOT_COMPILED = (
    f"hurcules in {Path(__file__).parent} is not compiled"
    + ("; this is the source tree" if _SOURCES.is_file() else "")
    + "; remedy: pip install . (or make product) at its top, and no PYTHONPATH to its sources"
)

try:
    __version__ = importlib.metadata.version("hurcules")
except importlib.metadata.PackageNotFoundError:
    raise ImportError(NOT_COMPILED) from None


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
        came = str(import_mujoco().__version__)
    except ModuleNotFoundError as error:
        if error.name != "mujoco":
            raise ImportError(_broken(error, wanted)) from error
        came = "none"
    except Exception as error:  # an import fails in many ways
        raise ImportError(_broken(error, wanted)) from error
    if came != wanted:
        raise ImportError(
            f"hurcules {__version__} needs MuJoCo {wanted}, installed is {came}; "
            f"remedy: pip install mujoco=={wanted}"
        )


def _broken(error: Exception, wanted: str) -> str:
    try:
        Path.cwd()
    except FileNotFoundError:
        return "the folder that this runs in was deleted; remedy: cd to one that exists"
    return (
        f"MuJoCo cannot be imported ({type(error).__name__}: {error}); "
        f"remedy: pip install --force-reinstall mujoco=={wanted}"
    )
