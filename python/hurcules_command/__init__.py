"""The console script `hurcules`.

It stands outside the package, so that Ctrl-C during the import of `hurcules` and a MuJoCo that
cannot be imported end in one line, and `hurcules doctor` works without either.
"""

from __future__ import annotations

import importlib.util
import os
import signal
import sys
from types import FrameType, ModuleType

__all__ = ["main"]


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
