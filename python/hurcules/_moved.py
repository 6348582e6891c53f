"""Old names of modules that have moved; each works for one release, with a DeprecationWarning."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Sequence
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType

__all__ = ["forward", "install", "new_name"]

# the first that fits counts; what lies below a module has moved with it
MOVED = {
    "hurcules.trials.drive": "hurcules.driving",
    "hurcules.trials.asked": "hurcules_studies.field_tests.parse",
    "hurcules.trials": "hurcules_studies.field_tests",
    "hurcules.reproduce.measures.marks": "hurcules_studies.thesis.measures.registry",
    "hurcules.reproduce": "hurcules_studies.thesis",
}


def new_name(name: str) -> str | None:
    """Where a module is now; None for one that has not moved."""
    for old, new in MOVED.items():
        if name == old or name.startswith(old + "."):
            return new + name.removeprefix(old)
    return None


def forward(old: str, stacklevel: int) -> ModuleType:
    """Warns about an old name and imports the module from its new place.

    Args:
        old: a name that has moved.
        stacklevel: of whoever used it, 2 for the caller.
    """
    new = new_name(old)
    assert new is not None
    text = f"{old} has moved to {new}; the old name goes with the next release"
    warnings.warn(text, DeprecationWarning, stacklevel=stacklevel)
    sys.modules[old] = import_module(new)  # what an import statement gets
    return sys.modules[old]


class _Finder(MetaPathFinder, Loader):
    """Finds modules by their old names."""

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        return ModuleSpec(name, self, is_package=True) if new_name(name) else None

    def exec_module(self, module: ModuleType) -> None:
        forward(module.__name__, 3)


def install() -> None:
    """Makes the old names work."""
    # first: a module at its new place has a folder, where others would find a second copy
    sys.meta_path.insert(0, _Finder())
