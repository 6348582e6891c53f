"""The claims of the thesis, measured here: `hurcules reproduce`.

`CLAIMS` is the list, 112 rows of data. `hurcules_studies.thesis.measures` holds one function a
claim, which measures and decides nothing. `judge` compares the two.
"""

from hurcules_studies.thesis.claim import Claim, Expected, Finding, Verdict
from hurcules_studies.thesis.claims import CLAIMS
from hurcules_studies.thesis.result import Result
from hurcules_studies.thesis.run import Reproduction, reproduce

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
