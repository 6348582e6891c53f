"""How Drive's expert climbs: tail first, upper legs over what is ahead, lower ones on the ground.

What is held straightens, lifts its tail higher, backs off, and comes again beside it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import mujoco
import numpy as np

from hurcules_envs.environment import Array
from hurcules_envs.rotations import quaternion
from hurcules_envs.steering import along
from hurcules_envs.terrain import AHEAD, BESIDE

__all__ = ["HOLDS", "MIDDLE", "climb", "keep_on", "ready_to_climb", "shown"]

# [rad] of the joints: lower legs turned over to the front, trunk and arms forward
JOINTS = {
    "LKN": math.pi, "RKN": math.pi, "HIP": 1.0, "LSP": 1.9, "RSP": 1.9, "LEB": 0.6, "REB": 0.6,
}  # fmt: skip
MIDDLE = 0.07  # [m] of the point that it turns about, its centre of mass, from the knee axis
TAIL, BATTERY = 0.6, 0.04  # [m] from the knees to the end of the upper legs; over their soles
# fitted on step fields of the seeds 0 to 3
CLEAR, ASIDE, HELD = 0.03, 0.16, 1.5  # [m] over what is ahead; beside what holds it; [s] until then
STRAIGHT, RAISED, HIGHER = -0.09, 0.75, 0.35  # [rad] of the knees: least, most, more where held
HOLDS = ("nearest", "held", "edge", "tries", "aside")  # what it remembers, one number each


def ready_to_climb(model: mujoco.MjModel, qpos: Array) -> Array:
    """A posture (nq,) as it is where it starts to climb: looking back, its joints as in JOINTS.

    Args:
        model: with the robot.
        qpos: (nq,) of it; stays as it is.
    """
    there = qpos.copy()
    there[3:7] = quaternion(np.array([0.0, 0.0, np.pi]))
    for joint, angle in JOINTS.items():
        there[model.joint(joint).qposadr[0]] = angle
    return there


def climb(seen: Mapping[str, Array]) -> tuple[Array, Array, Array]:
    """Speed along the heading [m/s], yaw rate and rate of the knees [rad/s], (n,) each.

    Args:
        seen: groups of Drive's observation: goal, up, legs, ground, held and aside.
    """
    goal, knee, ground = seen["goal"], seen["legs"][:, 0], seen["ground"]
    phase = seen["held"].sum(axis=1)
    rise = np.arcsin(np.clip(-seen["up"][:, 0], -1.0, 1.0))
    over, lying = _angles(ground, np.arcsin(np.clip(seen["up"][:, 1], -1.0, 1.0)))
    bend = over - np.maximum(rise - np.pi + knee, lying)
    bend = np.where(phase % 2 == 1, STRAIGHT, bend + np.where(phase == 2, HIGHER, 0.0))
    missing = np.pi - np.clip(bend, STRAIGHT, RAISED) - knee
    pace = np.clip(1.0 - np.abs(missing) / 0.15, np.where(phase > 0, 0.5, 0.0), 1.0)
    speed, rate = along(-goal[:, :2], goal, 0.4, seen["aside"][:, 0])
    retreats = phase == 3
    speed = np.where(retreats, -0.3, speed * pace)
    rate = np.where(retreats, 1.5 * np.arctan2(goal[:, 3], goal[:, 2]), rate)
    return -speed, rate, 6.0 * missing


def _angles(ground: Array, roll: Array) -> tuple[Array, Array]:
    """Angles [rad], (n,): of the upper legs over what is ahead; of the lower ones on the ground.

    Args:
        ground: (n, 225) [m] heights.
        roll: (n,) [rad] of the robot.
    """
    scan = ground.reshape(-1, len(AHEAD), len(BESIDE))
    scan = scan - np.tan(roll)[:, None, None] * BESIDE
    ahead = -AHEAD - MIDDLE  # [m] of the knees
    on, off = (ahead > 0.1) & (ahead < 1.0), (ahead < -0.15) & (ahead > -0.95)
    tracks = np.maximum(scan[:, on, 2], scan[:, on, 6])
    height = np.maximum(tracks, scan[:, on, 3:6].max(axis=2) - BATTERY) + CLEAR
    over = np.arctan2(height, np.minimum(ahead[on], TAIL)).max(axis=1)
    behind = scan[:, off][:, :, [0, 1, 7, 8]].max(axis=2)
    return over, -np.arctan2(behind, -ahead[off]).max(axis=1) - 0.1


def shown(memory: Mapping[str, Array], n: int) -> dict[str, Array]:
    """Groups held (n, 3) and aside (n, 1) of Drive's observation.

    Args:
        memory: (n, 1) each of HOLDS; without them it does not climb.
        n: how many robots.
    """
    if "held" not in memory:
        return {"held": np.zeros((n, 3)), "aside": np.zeros((n, 1))}
    return {"held": (memory["held"] // HELD > np.arange(3)).astype(float), "aside": memory["aside"]}


def keep_on(way: Array, memory: Mapping[str, Array], dt: float) -> None:
    """For how long what climbs is held, and how far beside its line it tries then.

    Args:
        way: (n,) [m] to the goal.
        memory: (n, 1) each of HOLDS; changed in place.
        dt: [s] since the last call.
    """
    nearest, held, edge, tries, aside = (memory[name][:, 0] for name in HOLDS)
    onward = way < nearest - 0.02
    held[:] = np.where(onward, 0.0, held + dt)
    nearest[:] = np.where(onward, way, nearest)
    begins = (held > 3 * HELD) & (edge != nearest)
    edge[begins] = nearest[begins]
    tries[begins] += 1
    aside[begins] = np.where(tries % 2 == 1, ASIDE, -ASIDE)[begins]
    over = (held > 3 * HELD) & (way > nearest + 0.4) | (held > 3 * HELD + 3.5)
    held[over], nearest[over] = 0.0, way[over]
    free = way < edge - 0.55
    aside[free], edge[free] = 0.0, 0.0
