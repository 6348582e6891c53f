"""The console scripts `hurcules` and `hurcules-sim`.

They stand outside the package, so that Ctrl-C during the import of `hurcules` and a MuJoCo that
cannot be imported end in one line, `hurcules doctor` works without either, and `hurcules-sim`
imports none of them.
"""

from __future__ import annotations

import importlib.util
import os
import signal
import sys
from types import FrameType, ModuleType

__all__ = ["main", "simulate"]


def main() -> int:
    """Imports the package and runs its command line; returns the exit code."""
    before = signal.signal(signal.SIGINT, _end)
    try:
        from hurcules import cli
    except ImportError as error:
        if sys.argv[1:] == ["doctor"]:
            return _doctor()
        print(f"hurcules: error: {error}", file=sys.stderr)
        return 1
    signal.signal(signal.SIGINT, before)
    sys.path.append("")  # a user's own modules in this folder, after all that is installed
    return cli.main()


def simulate() -> int:
    """Becomes the program `hurcules-sim`; returns where there is none."""
    package, mujoco = (importlib.util.find_spec(name) for name in ("hurcules", "mujoco"))
    if mujoco is None:
        print("hurcules-sim: MuJoCo is not installed; remedy: hurcules doctor", file=sys.stderr)
        return 1
    for folder in package.submodule_search_locations or () if package else ():
        path = os.path.join(folder, "hurcules-sim")
        if os.path.isfile(path):
            os.execv(path, [path, *sys.argv[1:]])
    print("hurcules-sim: hurcules is not compiled; remedy: pip install .", file=sys.stderr)
    return 1


def _end(_number: int, _frame: FrameType | None) -> None:
    """Ends at once: an exception inside an import would come out as an ImportError."""
    os.write(2, b"hurcules: interrupted\n")
    os._exit(130)


def _doctor() -> int:
    """`hurcules doctor` in plain text, from a package that cannot be imported whole."""
    for name in [name for name in sys.modules if name.split(".")[0] == "hurcules"]:
        del sys.modules[name]
    found = importlib.util.find_spec("hurcules")
    bare = ModuleType("hurcules")
    bare.__path__ = list(found.submodule_search_locations or ()) if found else []
    sys.modules["hurcules"] = bare
    from hurcules import doctor

    return doctor.report()
