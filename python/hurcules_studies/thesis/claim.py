"""What a claim of the thesis is: its words, the numbers that judge it, and what was found."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike

from hurcules.decimate import decimate

__all__ = [
    "ALGORITHM_1",
    "DEFAULT",
    "DLS_HQP",
    "HQP",
    "Claim",
    "Expected",
    "Finding",
    "Line",
    "Note",
    "Plot",
    "Verdict",
    "between",
    "exactly",
    "least",
    "line",
    "most",
    "near",
]


# the methods of the solver by which a claim is measured
DEFAULT, ALGORITHM_1, HQP, DLS_HQP = "default", "Algorithm 1", "HQP", "DLS-HQP"


class Verdict(StrEnum):
    """What became of a claim."""

    HOLDS = "holds"
    IN_PART = "holds in part"
    ANOTHER_NUMBER = "holds with another number"
    NOT = "does not hold"
    PENDING = "pending"
    ERROR = "error"


@dataclass(frozen=True)
class Expected:
    """Where a measured number must lie for the claim to hold: low <= number <= high.

    Attributes:
        what: the number, in words.
        low: [unit].
        high: [unit].
        unit: "s", "m", "rad", ...; "" for a plain number.
        thesis: as the thesis prints it, "" where it prints none.
        fitted: what was chosen so that the number comes near the thesis, such as a start posture;
            "" where nothing was. A number that was fitted is no evidence.
        figure: the claim is about more than this number: where the number is another one, the claim
            "holds with another number"; otherwise it does not hold.
        ours: where the number lies here, if that is elsewhere and the reason is known.
        why: that reason.
    """

    what: str
    low: float = -math.inf
    high: float = math.inf
    unit: str = ""
    thesis: str = ""
    fitted: str = ""
    figure: bool = False
    ours: tuple[float, float] | None = None
    why: str = ""

    def met(self, value: float) -> bool:
        """Whether the number is where the claim wants it."""
        return self.low <= value <= self.high

    def explained(self, value: float) -> bool:
        """Whether the number, elsewhere, is where the reason says."""
        return self.ours is not None and self.ours[0] <= value <= self.ours[1] and bool(self.why)


def most(what: str, high: float, unit: str = "", **more: object) -> Expected:
    """A number that must not be larger."""
    return Expected(what, high=high, unit=unit, **more)  # type: ignore[arg-type]


def least(what: str, low: float, unit: str = "", **more: object) -> Expected:
    """A number that must not be smaller."""
    return Expected(what, low=low, unit=unit, **more)  # type: ignore[arg-type]


def between(what: str, low: float, high: float, unit: str = "", **more: object) -> Expected:
    """A number with two sides."""
    return Expected(what, low, high, unit, **more)  # type: ignore[arg-type]


def near(what: str, value: float, tolerance: float, unit: str = "", **more: object) -> Expected:
    """A number that is known to a tolerance."""
    return Expected(what, value - tolerance, value + tolerance, unit, **more)  # type: ignore[arg-type]


def exactly(what: str, value: float, unit: str = "", **more: object) -> Expected:
    """A number that is known."""
    return Expected(what, value, value, unit, **more)  # type: ignore[arg-type]


@dataclass(frozen=True)
class Claim:
    """One row of the list.

    Attributes:
        id: a letter and two digits: R solver, E examples of Chapter 3, H hardware, M manipulation,
            S rescue stretch, F field, K force control, P appendix.
        source: section, equation or figure of the thesis.
        statement: what the thesis says, and how it is set up here.
        expected: by the name of the measured number.
        solvers: methods of the solver that ran, none where no hierarchy is solved.
        missing: what the statement says and the measurement leaves out; the claim then holds in
            part at best.
        caveat: what the numbers cannot show.
        pending: why nothing measures it yet.
    """

    id: str
    source: str
    statement: str
    expected: dict[str, Expected] = field(default_factory=dict)
    solvers: tuple[str, ...] = ()
    missing: str = ""
    caveat: str = ""
    pending: str = "not measured yet"

    @property
    def fitted(self) -> dict[str, str]:
        """What was fitted, by the names of the numbers that come from it."""
        return {name: one.fitted for name, one in self.expected.items() if one.fitted}


@dataclass(frozen=True)
class Note:
    """A number that is worth showing but decides nothing."""

    what: str
    value: float
    unit: str = ""


@dataclass(frozen=True)
class Line:
    """A line of a plot, few enough points to be kept; None breaks it.

    Attributes:
        style: "line", "dots", "dashed" or "faint".
    """

    label: str
    x: list[float]
    y: list[float | None]
    style: str = "line"


@dataclass(frozen=True)
class Plot:
    """A picture as data.

    Attributes:
        marks: upright lines where something happened here.
        thesis_marks: upright lines where the thesis says that it happened.
        levels: level lines, such as limits.
        log: axes with a logarithmic scale: "", "x", "y" or "xy".
    """

    title: str
    x_label: str
    y_label: str
    lines: list[Line]
    marks: tuple[float, ...] = ()
    thesis_marks: tuple[float, ...] = ()
    levels: tuple[float, ...] = ()
    log: str = ""


@dataclass
class Finding:
    """What a measurement gave.

    Attributes:
        values: by the names of `Claim.expected`.
        notes: further numbers.
        plots: at most three, shown side by side.
        remark: what a reader should know beside the numbers.
    """

    values: dict[str, float]
    notes: Sequence[Note] = ()
    plots: Sequence[Plot] = ()
    remark: str = ""


def line(label: str, x: ArrayLike, y: ArrayLike, style: str = "line", points: int = 400) -> Line:
    """A line whose picture is that of all points, with about as many as `points`."""
    x_all, y_all = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    finite = np.where(np.isfinite(y_all), y_all, 0.0)
    if x_all.size > points:
        keep, _ = decimate(np.arange(x_all.size, dtype=float), finite, points // 2)
        index = np.unique(keep.astype(int))
        x_all, y_all = x_all[index], y_all[index]
    return Line(
        label, _short(x_all), [v if math.isfinite(v) else None for v in _short(y_all)], style
    )


def _short(values: Iterable[float]) -> list[float]:
    """Six digits are enough for a picture."""
    return [float(f"{value:.6g}") for value in values]
