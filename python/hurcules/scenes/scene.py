"""The base of all scenes: a name, parameters as fields, and a way to build it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import ClassVar

from hurcules.scenes.ground import Ground
from hurcules.scenes.parameters import number, require_fields

__all__ = ["Scene"]


@dataclass(frozen=True)
class Scene:
    """A kind of surroundings; its fields are what one can ask for.

    Attributes:
        source: the test method or standard that it follows, "" for none.
    """

    source: ClassVar[str] = ""
    friction: float = number(0.9, 0.05, 1.5, "", "sliding friction of the ground")

    def __post_init__(self) -> None:
        """Checks the parameters."""
        require_fields(self.kind(), self)

    @classmethod
    def kind(cls) -> str:
        """The scene's name: that of the class in snake_case."""
        return re.sub(r"(?<!^)(?=[A-Z])", "_", cls.__name__).lower()

    @property
    def end(self) -> float:
        """Where the obstacle ends, and its landing begins [m] along x; 0 without an obstacle."""
        return 0.0

    def build(self, ground: Ground) -> None:
        """Puts the scene on the ground; the robot stands at the origin and looks along +x."""
        raise NotImplementedError
