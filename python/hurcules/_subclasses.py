"""Classes of tasks in Python: controllers measure in C++, and ask no method of theirs."""

from __future__ import annotations

from typing import Any

from hurcules import _core

__all__ = ["install"]

# what a controller would be thought to ask, the last two by mink and Pink
MEASURED = ("drift", "error", "jacobian", "update", "value", "compute_error", "compute_jacobian")


def install() -> None:
    """Refuses a class whose measuring would be passed over."""
    _core.Task.__init_subclass__ = classmethod(_require_function)  # type: ignore[assignment]


def _require_function(kind: type, /, **_: Any) -> None:
    base = next(one.__name__ for one in kind.__mro__ if one.__module__ == _core.__name__)
    written = [name for name in MEASURED if name in vars(kind)]
    if written or base in ("Task", "ValueTask"):
        what = f"'{written[0]}'" if written else "it"
        raise _core.Error(
            f"class {kind.__name__}: a {base} is measured in C++, which asks no class of Python "
            f"for {what}; CustomTask(name, robot, rows, function) measures what a function says"
        )
