"""Test methods for response robots: the largest gap, hurdle, incline that is passed, and how sure.

`field_tests.run("e2803")` climbs steeper and steeper inclines, ten times each; see `METHODS`.
"""

from hurcules_studies.field_tests.attempt import Repetition, Variation, repeat
from hurcules_studies.field_tests.methods import METHODS, Method, method
from hurcules_studies.field_tests.postures import FLAT, Plan, Posture
from hurcules_studies.field_tests.reliability import confidence, lower_bound, repetitions_needed
from hurcules_studies.field_tests.runner import Result, SettingResult, run

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
