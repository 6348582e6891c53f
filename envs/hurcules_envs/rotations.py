"""Rotations as arrays with any leading axes."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

__all__ = ["quaternion", "rotation_vector", "turn_between"]

Array = NDArray[np.float64]


def quaternion(vector: Array) -> Array:
    """(..., 4) w, x, y, z with w >= 0 of rotation vectors (..., 3) [rad]."""
    angle = np.sqrt(np.einsum("...i,...i->...", vector, vector))[..., None]
    result = np.concatenate([np.cos(angle / 2), np.sinc(angle / (2 * np.pi)) * vector / 2], axis=-1)
    return np.where(result[..., :1] < 0.0, -result, result)


def turn_between(one: Array, other: Array) -> Array:
    """(..., 3) [rad] rotation vector, in the world, that turns quaternion one (..., 4) to other."""
    w, v = one[..., :1], one[..., 1:]
    W, V = other[..., :1], other[..., 1:]
    cosine = w * W + np.einsum("...i,...i->...", v, V)[..., None]
    sine = w * V - W * v - np.cross(V, v)
    sine = np.where(cosine < 0.0, -sine, sine)  # the short way round
    length = np.linalg.norm(sine, axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(length, np.abs(cosine))
    return np.asarray(np.where(length > 1e-9, angle / np.maximum(length, 1e-9), 2.0) * sine)


def rotation_vector(R: Array) -> Array:
    """(3,) [rad] of a rotation matrix (3, 3)."""
    turn, vector = np.zeros(4), np.zeros(3)
    mujoco.mju_mat2Quat(turn, R.reshape(9))
    mujoco.mju_quat2Vel(vector, turn, 1.0)
    return vector
