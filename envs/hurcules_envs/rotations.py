"""Rotations as arrays with any leading axes."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

__all__ = ["angle_between", "quaternion", "rotation_vector"]

Array = NDArray[np.float64]


def quaternion(vector: Array) -> Array:
    """(..., 4) w, x, y, z with w >= 0 of rotation vectors (..., 3) [rad]."""
    angle = np.sqrt(np.einsum("...i,...i->...", vector, vector))[..., None]
    result = np.concatenate([np.cos(angle / 2), np.sinc(angle / (2 * np.pi)) * vector / 2], axis=-1)
    return np.where(result[..., :1] < 0.0, -result, result)


def angle_between(one: Array, other: Array) -> Array:
    """(...) [rad] from 0 to pi between quaternions (..., 4), which need not have unit length."""
    product = np.abs(np.einsum("...i,...i->...", one, other))
    lengths = np.linalg.norm(one, axis=-1) * np.linalg.norm(other, axis=-1)
    return 2.0 * np.arccos(np.clip(product / np.maximum(lengths, 1e-12), 0.0, 1.0))


def rotation_vector(R: Array) -> Array:
    """(3,) [rad] of a rotation matrix (3, 3)."""
    turn, vector = np.zeros(4), np.zeros(3)
    mujoco.mju_mat2Quat(turn, R.reshape(9))
    mujoco.mju_quat2Vel(vector, turn, 1.0)
    return vector
