"""F01 to F07: the sequences of the field tests. Nothing measures them before the missions exist."""

from hurcules_studies.thesis.claim import Claim

__all__ = ["FIELD"]

_WAITS = "the missions of the field tests are not there yet"

FIELD = (
    Claim(
        "F01",
        "§4.5, Fig. 4.27",
        "Ordnance: twelve steps (drive, waist, both legs, stand, four of acquisition, lift and "
        "sit, waist and "
        "right leg, waist and left leg, torso forward and lean).",
        pending=_WAITS,
    ),
    Claim(
        "F02",
        "Fig. 4.28",
        "Casualty: twelve steps, with folded arms, penetration under the body, lift, one leg at "
        "a time, "
        "bed deployed, put down, arms pulled out.",
        pending=_WAITS,
    ),
    Claim(
        "F03",
        "§4.5",
        "No self-collision in any transformation; legs rotated without turned waist and folded "
        "arms do "
        "collide.",
        pending=_WAITS,
    ),
    Claim(
        "F04",
        "§4.5",
        "Seven missions of 400 m round trip within two hours.",
        pending=_WAITS,
    ),
    Claim(
        "F05",
        "§4.5",
        "Arms without power while driving keep their pose.",
        pending=_WAITS,
    ),
    Claim(
        "F06",
        "§4.5",
        "The lower arms go under the casualty; too much friction or contact force blocks it.",
        pending=_WAITS,
    ),
    Claim(
        "F07",
        "Fig. 4.29",
        "Camera views at lifting-ready, acquisition and lifting.",
        pending=_WAITS,
    ),
)
