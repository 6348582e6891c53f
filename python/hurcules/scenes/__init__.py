"""Scenes made from parameters and a seed: slopes, gaps, stairs, rough ground, things to handle.

`scenes.make("slope", angle=0.5)` is an MjSpec of the ground alone, `scenes.load("slope", "rescue",
angle=0.5)` the compiled model with the robot standing on it. The same call gives the same bits.
"""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np

from hurcules import mjcf
from hurcules._core import Error
from hurcules.scenes.casualty import Casualty
from hurcules.scenes.disposal import Disposal
from hurcules.scenes.flat import Flat, Pylons
from hurcules.scenes.gap import Gap, Trench
from hurcules.scenes.ground import Ground
from hurcules.scenes.hurdle import Hurdle
from hurcules.scenes.load import ForcePad, Lift
from hurcules.scenes.overlap import require_clear
from hurcules.scenes.parameters import Parameter, parameters_of
from hurcules.scenes.ramps import Ramps
from hurcules.scenes.rough import Gravel, RoughRoad, Sand
from hurcules.scenes.scene import Scene
from hurcules.scenes.slope import Incline, Slope
from hurcules.scenes.stairs import Stairs, Steps
from hurcules.scenes.step_field import StepField
from hurcules.scenes.things import Debris, Door, Ordnance, Sled, Valve
from hurcules.validation import require_known

__all__ = ["PRESETS", "Parameter", "Scene", "load", "make", "names", "parameters", "scene"]

_KINDS: dict[str, type[Scene]] = {
    kind.kind(): kind
    for kind in (
        Flat, Slope, Incline, Gap, Trench, Hurdle, Steps, Stairs, Ramps, StepField, RoughRoad,
        Gravel, Sand, Pylons, Sled, Casualty, Ordnance, Disposal, Lift, ForcePad, Debris, Door,
        Valve,
    )
}  # fmt: skip

# names with fixed parameters, for `models.load(scene=...)`
PRESETS: dict[str, tuple[str, dict[str, Any]]] = {
    "slope30": ("slope", {}),
    "slope30_down": ("slope", {"direction": "down"}),
    "slope30_across": ("slope", {"direction": "across"}),
    "stairs35": ("stairs", {"pitch": math.radians(35)}),
    "crossing_ramps": ("ramps", {"pattern": "crossing"}),
}


def names() -> list[str]:
    """Returns the kinds of scenes, easy ones first."""
    return list(_KINDS)


def parameters(name: str) -> list[Parameter]:
    """Returns what a kind of scene can be asked for.

    Raises:
        Error: no such kind; the text lists those that exist.
    """
    return parameters_of(_kind(name))


def scene(name: str, **values: Any) -> Scene:
    """Returns a checked set of parameters.

    Args:
        name: one of `names()` or of `PRESETS`.
        values: parameters of this kind; the others keep their defaults.

    Raises:
        Error: no such kind or parameter, or a value out of range; the text says what was wanted.
    """
    name, preset = PRESETS.get(name, (name, {}))
    kind = _kind(name)
    known = [parameter.name for parameter in parameters_of(kind)]
    for key in values:
        if key not in known:
            raise Error(f"{name}: no parameter '{key}'; there are: {', '.join(known)}")
    return kind(**(preset | values))


def make(name: str, *, robot: str | None = None, seed: int = 0, **values: Any) -> mujoco.MjSpec:
    """Builds a scene.

    Args:
        name: one of `names()` or of `PRESETS`.
        robot: one of `models.names()`, which starts at its place in the scene; None for none.
        seed: a whole number >= 0; everything that is drawn follows from it.
        values: parameters of this kind, SI units, angles in radians.

    Returns:
        The uncompiled model; `.compile()` makes an MjModel, `.to_xml()` MJCF text after that.

    Raises:
        Error: no such kind, parameter or robot, a value out of range, or a bad seed.
    """
    wanted = scene(name, **values)
    whole = isinstance(seed, int | np.integer) and not isinstance(seed, bool)
    if not whole or seed < 0:
        raise Error(f"{name}: seed wants a whole number >= 0, got {seed!r}")
    if robot is not None:
        require_known("robot", robot, mjcf.robots())
    ground = Ground(robot, wanted.friction, seed)
    ground.spec.modelname = name if robot is None else f"{robot} in {name}"
    wanted.build(ground)
    return ground.spec


def load(name: str, robot: str = "rescue", *, seed: int = 0, **values: Any) -> mujoco.MjModel:
    """Builds and compiles a scene with a robot in it.

    Args:
        name: one of `names()` or of `PRESETS`.
        robot: one of `models.names()`.
        seed: as for `make`.
        values: as for `make`.

    Raises:
        Error: as for `make`; or the robot overlaps what is in the scene where it starts.
    """
    model = make(name, robot=robot, seed=seed, **values).compile()
    require_clear(model, name)
    return model


def _kind(name: str) -> type[Scene]:
    if name not in _KINDS:
        known = ", ".join([*_KINDS, *PRESETS])
        raise Error(f"scene '{name}' does not exist; there are: {known}")
    return _KINDS[name]
