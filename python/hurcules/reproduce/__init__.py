"""The claims of the thesis, measured here: `hurcules reproduce`.

`CLAIMS` is the list, 112 rows of data. `hurcules.reproduce.measures` holds one function a claim,
which measures and decides nothing. `judge` compares the two.
"""

from hurcules.reproduce.claim import Claim, Expected, Finding, Verdict
from hurcules.reproduce.claims import CLAIMS
from hurcules.reproduce.result import Result
from hurcules.reproduce.run import Reproduction, reproduce

__all__ = [
    "CLAIMS",
    "Claim",
    "Expected",
    "Finding",
    "Reproduction",
    "Result",
    "Verdict",
    "reproduce",
]
