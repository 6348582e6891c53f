"""The list: 112 claims of the thesis as data, each with the numbers that it is judged by.

Sources: section, equation, figure or table of the thesis. "Reference" numbers were computed apart
from this code (same printed inputs, own small programs); where a claim names none, the number is
what the claim's words say, with the rounding of double arithmetic.
"""

from hurcules_studies.thesis.claim import Claim
from hurcules_studies.thesis.claims.appendix import APPENDIX
from hurcules_studies.thesis.claims.examples import EXAMPLES
from hurcules_studies.thesis.claims.field import FIELD
from hurcules_studies.thesis.claims.force import FORCE
from hurcules_studies.thesis.claims.hardware import HARDWARE
from hurcules_studies.thesis.claims.manipulation import MANIPULATION
from hurcules_studies.thesis.claims.solver import SOLVER
from hurcules_studies.thesis.claims.stretch import STRETCH

__all__ = ["CLAIMS", "LETTERS"]

LETTERS = {
    "R": "The solver (Chapters 2 and 3)",
    "E": "The examples of Chapter 3",
    "H": "The hardware (Chapter 4)",
    "M": "Manipulation with 19 degrees of freedom (§4.3)",
    "S": "The stretch for a casualty, 13 degrees of freedom (§4.4)",
    "F": "Field tests (§4.5)",
    "K": "Motion and force (Chapter 5)",
    "P": "The joint servo (Appendix)",
}

CLAIMS: dict[str, Claim] = {
    claim.id: claim
    for claims in (
        SOLVER,
        EXAMPLES,
        HARDWARE,
        MANIPULATION,
        STRETCH,
        FIELD,
        FORCE,
        APPENDIX,
    )
    for claim in claims
}
