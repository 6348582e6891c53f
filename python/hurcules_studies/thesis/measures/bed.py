"""H16: the transfer bed expands by its own motors, and what it stands in the way of."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import mujoco
import numpy as np

import hurcules
from hurcules import models, transfer_bed
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.registry import measures
from hurcules_studies.thesis.measures.rig import start, touching

TRUNK = {"waist", "waist_top", "torso"}
HIP_ANGLES = np.arange(0.9, 1.65, 0.01)  # [rad]


def first_touch(
    model: mujoco.MjModel,
    key: str,
    joint: str,
    angles: Iterable[float],
    groups: tuple[set[str], set[str]],
) -> float | None:
    """The first of some angles [rad] at which geoms of two groups meet."""
    data = mujoco.MjData(model)
    for angle in angles:
        mujoco.mj_resetDataKeyframe(model, data, model.key(key).id)
        data.joint(joint).qpos[0] = angle
        if any(set(pair) & groups[0] and set(pair) & groups[1] for pair in touching(model, data)):
            return float(angle)
    return None


def ground_angle(model: mujoco.MjModel, parts: Sequence[str]) -> float | None:
    """Upper-leg elevation [rad] at which the lowest corner of some boxes meets the ground."""
    data = mujoco.MjData(model)
    for theta in np.arange(1.5, 3.0, 0.01):
        mujoco.mj_resetDataKeyframe(model, data, model.key("ready").id)
        data.qpos[3:7] = [np.cos(theta / 2), 0, np.sin(theta / 2), 0]
        data.joint("LKN").qpos[0] = data.joint("RKN").qpos[0] = np.pi - theta
        mujoco.mj_kinematics(model, data)
        for name in parts:
            geom = data.geom(name)
            down = abs(geom.xmat.reshape(3, 3)[2]) @ model.geom(name).size
            if geom.xpos[2] - down < 0:
                return float(theta)
    return None


@measures("H16")
def bed() -> Finding:
    """Out by its motors; then the ranges of hip and knee with it and without, and contacts."""
    model = models.load("rescue")
    data, player = start(model, "rescue", "drive")
    height: list[tuple[float, float, float]] = []

    def watch() -> None:
        half = float(data.geom("L_bed_2").xpos[1]) + float(model.geom("L_bed_2").size[1])
        height.append((float(data.time), float(data.site("bed").xpos[2]), 2.0 * half))

    player.watch = watch
    out = player.play(transfer_bed.expand())
    raised, length = height[-1][1], height[-1][2]
    folded = player.play(transfer_bed.fold())
    log = np.array(height)
    bare = models.load("rescue", bed=False)
    ranges = [hurcules.mode_ranges(f"rescue_ready{end}") for end in ("", "_without_bed")]
    hip = [one["HIP"][1] for one in ranges]
    knee = [one["KN"][0] for one in ranges]
    met = [
        first_touch(model, "ready", "HIP", HIP_ANGLES, (TRUNK, {"transfer_bed"})),
        first_touch(bare, "ready", "HIP", HIP_ANGLES, (TRUNK, {"battery"})),
    ]
    ground = [ground_angle(model, ["transfer_bed"]), ground_angle(bare, ["battery"])]
    if None in (*met, *ground):
        raise RuntimeError("trunk or legs meet nothing in their whole range")
    return Finding(
        {
            "raised": raised,
            "length": length,
            "folded": abs(float(log[-1, 1] - log[0, 1])),
            "saturated": sum(result.worst_torque >= 1.0 for result in out + folded),
            "collisions": sum(len(result.collisions) for result in out + folded),
            "hip": hip[1] - hip[0],
            "knee": knee[0] - knee[1],
            "hip_room": min(float(m or 0.0) - h for m, h in zip(met, hip, strict=True)),
            "knee_room": min(
                k - (np.pi - float(g or 0.0)) for g, k in zip(ground, knee, strict=True)
            ),
        },
        [
            Note("the trunk meets the bed at a hip angle of", float(met[0] or 0.0), "rad"),
            Note("without bed it meets the battery at", float(met[1] or 0.0), "rad"),
        ],
        [
            Plot("Lying surface", "time [s]", "height [m]", [line("", log[:, 0], log[:, 1])]),
            Plot("Length across the robot", "time [s]", "[m]", [line("", log[:, 0], log[:, 2])]),
        ],
    )
