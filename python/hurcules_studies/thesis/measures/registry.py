"""The mark of a function that measures a claim."""

from __future__ import annotations

from collections.abc import Callable

from hurcules_studies.thesis.claim import Finding

__all__ = ["FUNCTIONS", "measures"]

Function = Callable[[], Finding]

FUNCTIONS: dict[str, Function] = {}  # by id


def measures(name: str) -> Callable[[Function], Function]:
    """Marks the one function that measures a claim."""

    def mark(function: Function) -> Function:
        if name in FUNCTIONS:
            raise ValueError(f"claim {name} is measured twice")
        FUNCTIONS[name] = function
        return function

    return mark
