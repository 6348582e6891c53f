"""Test methods for response robots: the largest gap, hurdle, incline that is passed, and how sure.

`trials.run("e2803")` climbs steeper and steeper inclines, ten times each; see `METHODS`.
"""

from hurcules.trials.attempt import Repetition, Variation, repeat
from hurcules.trials.methods import METHODS, Method, method
from hurcules.trials.postures import FLAT, Plan, Posture
from hurcules.trials.reliability import confidence, lower_bound, repetitions_needed
from hurcules.trials.runner import Result, SettingResult, run

__all__ = [
    "FLAT",
    "METHODS",
    "Method",
    "Plan",
    "Posture",
    "Repetition",
    "Result",
    "SettingResult",
    "Variation",
    "confidence",
    "lower_bound",
    "method",
    "repeat",
    "repetitions_needed",
    "run",
]
