"""Looks of the ground: plain colours, and two textures with grains."""

from __future__ import annotations

from typing import Any

import mujoco

__all__ = ["add_materials"]

PLAIN = {
    "concrete": (0.60, 0.59, 0.56),
    "dark_concrete": (0.44, 0.44, 0.43),
    "wood": (0.60, 0.49, 0.34),  # OSB
    "timber": (0.50, 0.39, 0.26),
    "steel": (0.52, 0.54, 0.56),
    "earth": (0.38, 0.31, 0.23),
    "sign": (0.93, 0.42, 0.05),
}
GRAINS = {
    "gravel": ((0.50, 0.48, 0.45), (0.30, 0.29, 0.28)),
    "sand": ((0.64, 0.56, 0.42), (0.56, 0.48, 0.36)),
}


def add_materials(spec: Any) -> None:
    """Adds what the model does not have yet."""
    present = {material.name for material in spec.materials}
    for name, colour in PLAIN.items():
        if name not in present:
            spec.add_material(name=name, rgba=[*colour, 1.0], specular=0.05, shininess=0.1)
    for name, (colour, grain) in GRAINS.items():
        _add_grains(spec, name, colour, grain)


def _add_grains(spec: Any, name: str, colour: Any, grain: Any) -> None:
    spec.add_texture(
        name=name,
        type=mujoco.mjtTexture.mjTEXTURE_2D,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_FLAT,
        mark=mujoco.mjtMark.mjMARK_RANDOM,
        rgb1=colour,
        rgb2=colour,
        markrgb=grain,
        random=0.3,
        width=256,
        height=256,
    )
    material = spec.add_material(name=name, texrepeat=[2, 2], texuniform=True, specular=0.02)
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = name
