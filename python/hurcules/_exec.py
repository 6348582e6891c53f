"""Where the program hurcules-sim lies."""

import importlib.util
from pathlib import Path


def program() -> Path:
    """Returns its path: beside hurcules._core, in an editable install too."""
    spec = importlib.util.find_spec("hurcules._core")
    if spec is None or spec.origin is None:
        raise SystemExit("hurcules-sim: hurcules._core is not installed; remedy: pip install .")
    return Path(spec.origin).with_name("hurcules-sim")
