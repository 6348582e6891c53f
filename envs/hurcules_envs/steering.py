"""Laws that lead a tracked robot to a pose: speed and yaw rate of what it sees of it."""

from __future__ import annotations

import numpy as np

from hurcules_envs.environment import Array

__all__ = ["along", "steady", "to_pose"]

FOLDED = 0.02  # [rad] of the knees, within which both tracks of a leg lie on the ground
SLOW = 0.5  # [m/s], [rad/s] of the drive with its legs off the ground, or on their tips
GENTLE = 1.0  # [m/s^2] there
NEARLY, FOLDS = 0.1, 0.3  # [rad] of the knees, from where they fold for a faster drive; [rad/s]


def steady(drive: Array, legs: Array, knee: Array, speed: Array, dt: float) -> tuple[Array, Array]:
    """A drive and legs that do not tip the robot over on flat ground.

    With its legs unfolded it drives slowly and changes its speed gently, and it moves them only
    when it is slow: half of its support goes with them. Nearly folded they fold where it is to
    drive faster.

    Args:
        drive: (n, 2) speed [m/s], yaw rate [rad/s].
        legs: (n, k) [rad/s] of the knees.
        knee: (n, 1) [rad].
        speed: (n,) [m/s] of the robot along its heading.
        dt: [s] until the next command.
    """
    slow = np.clip(drive, -SLOW, SLOW)
    slow[:, 0] = np.clip(slow[:, 0], speed - GENTLE * dt, speed + GENTLE * dt)
    fast = (np.abs(drive) > SLOW).any(axis=1, keepdims=True)
    legs = np.where(np.abs(speed[:, None]) < SLOW + 0.1, legs, 0.0)
    fold = np.clip(-knee / dt, -FOLDS, FOLDS)
    legs = np.where(fast & (np.abs(knee) < NEARLY), fold, legs)
    return np.where(np.abs(knee) < FOLDED, drive, slow), legs


def to_pose(goal: Array) -> tuple[Array, Array]:
    """Speed [m/s] and yaw rate [rad/s] of a smooth law for unicycles (Park and Kuipers, ICRA 2011).

    Args:
        goal: (n, 4) seen from the robot: x, y [m], cosine and sine of the heading.
    """
    way = np.linalg.norm(goal[:, :2], axis=1)
    sight = np.arctan2(goal[:, 1], goal[:, 0])  # of the goal, from the heading
    turn = np.arctan2(goal[:, 3], goal[:, 2])
    delta, theta = _wrap(-sight), _wrap(turn - sight)
    k1, k2 = 1.0, 3.0
    bend = k2 * (delta - np.arctan(-k1 * theta)) + (1 + k1 / (1 + (k1 * theta) ** 2)) * np.sin(
        delta
    )
    bend = -bend / np.maximum(way, 0.05)
    speed = np.minimum(1.2 / (1.0 + 0.4 * np.abs(bend) ** 1.5), 0.8 * way)
    near = way < 0.15
    speed = np.where(near, 0.0, np.maximum(speed, 0.08))
    return speed, np.where(near, 1.5 * turn, speed * bend)


def along(way: Array, goal: Array, most: float, aside: Array | float = 0.0) -> tuple[Array, Array]:
    """Speed [m/s] and yaw rate [rad/s] along the goal's own line.

    Args:
        way: (n, 2) [m] to the goal, ahead and to the left of where it drives to.
        goal: (n, 4) as in `to_pose`.
        most: of the speed [m/s].
        aside: [m] to the left of the line to keep to.
    """
    turn, x = np.arctan2(goal[:, 3], goal[:, 2]), way[:, 0]
    there = np.abs(x) < 0.1
    left = np.cos(turn) * way[:, 1] - np.sin(turn) * x + aside
    turn = turn + np.where(x > 0.1, np.clip(1.5 * left, -0.4, 0.4), 0.0)
    speed = np.where(there, 0.0, np.clip(x, -0.25, most))
    return speed, np.where(there & (np.abs(turn) < 0.15), 0.0, 1.5 * turn)


def _wrap(angle: Array) -> Array:
    return (angle + np.pi) % (2.0 * np.pi) - np.pi
