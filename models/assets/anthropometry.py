"""What is known of a limp adult's body: masses, centres, radii of gyration, lengths.

Masses, centres and radii: de Leva 1996 (male), as fractions; their segment lengths [m at 1.741 m
stature] are from memory of the same paper. Lengths between joints: Drillis and Contini (Winter), as
fractions of the stature. Metres and kilograms.
"""

from dataclasses import dataclass

__all__ = ["JOINT_LENGTHS", "REFERENCE", "SEGMENTS", "Person", "Segment"]

DE_LEVA_STATURE = 1.741  # [m]


@dataclass(frozen=True)
class Segment:
    """One row of de Leva's table."""

    mass: float  # fraction of the body's mass
    centre: float  # centre of mass from the proximal end, fraction of the length
    gyration: tuple[float, float, float]  # about x, y, long axis; fraction of the length
    length: float  # [m] at de Leva's stature


SEGMENTS = {
    "head": Segment(0.0694, 0.5976, (0.362, 0.376, 0.312), 0.2033),
    "thorax": Segment(0.1596, 0.2999, (0.716, 0.454, 0.659), 0.1707),
    "abdomen": Segment(0.1633, 0.4502, (0.482, 0.383, 0.468), 0.2155),
    "pelvis": Segment(0.1117, 0.6115, (0.615, 0.551, 0.587), 0.1457),
    "upper_arm": Segment(0.0271, 0.5772, (0.285, 0.269, 0.158), 0.2817),
    "forearm": Segment(0.0162, 0.4574, (0.276, 0.265, 0.121), 0.2689),
    "hand": Segment(0.0061, 0.7900, (0.628, 0.513, 0.401), 0.0862),
    "thigh": Segment(0.1416, 0.4095, (0.329, 0.329, 0.149), 0.4222),
    "shank": Segment(0.0433, 0.4395, (0.251, 0.246, 0.102), 0.4340),
    "foot": Segment(0.0137, 0.4415, (0.257, 0.245, 0.124), 0.2581),
}

# fractions of the stature; trunk lengths are de Leva's own
JOINT_LENGTHS = {
    "upper_arm": 0.186,
    "forearm": 0.146,
    "hand": 0.108,
    "thigh": 0.245,
    "shank": 0.246,
    "hip_height": 0.530,
    **{name: SEGMENTS[name].length / DE_LEVA_STATURE for name in ("thorax", "abdomen", "pelvis")},
}


@dataclass(frozen=True)
class Person:
    """A body of some mass [kg] and stature [m]."""

    mass: float
    stature: float

    @property
    def scale(self) -> float:
        """Lengths relative to the reference person."""
        return self.stature / REFERENCE.stature

    @property
    def girth(self) -> float:
        """Thickness relative to the reference person: the same density."""
        return (self.mass / REFERENCE.mass / self.scale) ** 0.5

    def length(self, name: str) -> float:
        """Distance from joint to joint [m]; for the hand and the height of the hips as named."""
        return JOINT_LENGTHS[name] * self.stature

    @property
    def head_height(self) -> float:
        """From the base of the neck to the vertex [m]: what trunk and legs leave of the stature."""
        trunk = sum(self.length(name) for name in ("pelvis", "abdomen", "thorax"))
        return self.stature - self.length("hip_height") - trunk

    def segment_mass(self, name: str) -> float:
        """[kg]."""
        return SEGMENTS[name].mass * self.mass

    def centre(self, name: str) -> float:
        """Centre of mass from the proximal end [m]."""
        return SEGMENTS[name].centre * self._length(name)

    def inertia(self, name: str) -> tuple[float, float, float]:
        """About x, y and the long axis through the centre of mass [kg m2]."""
        mass, length = self.segment_mass(name), self._length(name)
        x, y, along = (mass * (k * length) ** 2 for k in SEGMENTS[name].gyration)
        return x, y, along

    def _length(self, name: str) -> float:
        return SEGMENTS[name].length * self.stature / DE_LEVA_STATURE


REFERENCE = Person(75.0, 1.75)
