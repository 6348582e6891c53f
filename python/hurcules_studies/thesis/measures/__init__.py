"""How each claim is measured: a function a claim, marked `@measures("M04")`, in the modules here.

A module is a bundle: its claims are measured by one worker, so that they can share a run (by
`functools.cache`). To add a claim: write its function, and its expected numbers in
`hurcules_studies.thesis.claims`; a new module also goes into MODULES.
"""

from __future__ import annotations

from importlib import import_module

from hurcules_studies.thesis.claim import Finding
from hurcules_studies.thesis.measures.registry import FUNCTIONS

__all__ = ["ALONE", "MODULES", "bundles", "measure", "measured"]

# the longest first, so that the workers end together
MODULES = (
    "missions",
    "transformation",
    "obstacles",
    "reach",
    "force_sequence",
    "force_entry",
    "force_lowering",
    "force_reach",
    "force_casualty",
    "look_and_move",
    "views",
    "carrying",
    "stretch",
    "driving",
    "bimanual",
    "tasks",
    "servo_robot",
    "monitors",
    "elbow_spring",
    "bed",
    "servo_arm",
    "position_limits",
    "decomposition",
    "active_set",
    "regularization",
    "chapter3",
    "force_second_order",
    "force_first_order",
    "servo_theory",
    "hardware",
    "solve_times",
    "tick_times",
)
# those that measure time: nothing else runs beside them
ALONE = ("solve_times", "tick_times")


def _load() -> None:
    for module in MODULES:
        import_module(f"{__name__}.{module}")


def measured() -> dict[str, str]:
    """The ids that something measures, each with its module."""
    _load()
    return {name: function.__module__.rpartition(".")[2] for name, function in FUNCTIONS.items()}


def measure(name: str) -> Finding:
    """Measures a claim.

    Args:
        name: an id among `measured()`.
    """
    _load()
    return FUNCTIONS[name]()


def bundles(names: list[str]) -> tuple[list[list[str]], list[list[str]]]:
    """The ids by module: those that may run side by side, and those that want to be alone."""
    module_of = measured()
    by_module = {
        module: [name for name in names if module_of.get(name) == module] for module in MODULES
    }
    beside = [ids for module, ids in by_module.items() if ids and module not in ALONE]
    alone = [ids for module, ids in by_module.items() if ids and module in ALONE]
    return beside, alone
