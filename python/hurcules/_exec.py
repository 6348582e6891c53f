"""Console script hurcules-sim: becomes the program that lies beside the compiled module."""

import importlib.util
import os
import sys
from pathlib import Path


def program() -> Path:
    """Returns where the program lies: beside hurcules._core, in an editable install too."""
    spec = importlib.util.find_spec("hurcules._core")
    if spec is None or spec.origin is None:
        raise SystemExit("hurcules-sim: hurcules._core is not installed; remedy: pip install .")
    return Path(spec.origin).with_name("hurcules-sim")


def main() -> None:
    """Replaces this process; nothing of Python is left."""
    path = str(program())
    os.execv(path, [path, *sys.argv[1:]])
