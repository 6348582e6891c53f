"""H14, H15: the elbow springs of the rescue robot, its lower arms set down onto the ground."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import mujoco
import numpy as np

import hurcules
from hurcules import models, postures
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures
from hurcules_studies.thesis.measures.rig import start

DOWN = 0.12  # [rad] that the shoulders lower the scoops: their tips are 0.09 m above the ground
SHOULDER = 0.876  # [rad] in the acquisition
QUICK, SLOW = 0.8, 4.0  # [s] on the way down


def contact_moment(model: mujoco.MjModel, data: mujoco.MjData, side: str) -> tuple[float, float]:
    """Moment about the elbow spring of all contacts of a lower arm [N m], and its force up [N]."""
    arm, joint = model.body(f"{side}_larm").id, data.joint(f"{side}EBS")
    moment, force, wrench = 0.0, 0.0, np.zeros(6)
    for i, contact in enumerate(data.contact[: data.ncon]):
        bodies = model.geom_bodyid[contact.geom]
        if arm not in bodies:
            continue
        mujoco.mj_contactForce(model, data, i, wrench)
        push = contact.frame.reshape(3, 3).T @ wrench[:3] * (1 if bodies[1] == arm else -1)
        moment += joint.xaxis @ np.cross(contact.pos - joint.xanchor, push)
        force += push[2]
    return float(moment), float(force)


def lock(model: mujoco.MjModel) -> mujoco.MjModel:
    """The same robot with rigid elbows."""
    for side in "LR":
        dof = model.joint(f"{side}EBS").dofadr[0]
        model.dof_frictionloss[dof] = 1e5
        model.dof_solref[dof], model.dof_solimp[dof] = [0.004, 1], [0.9999, 0.9999, 0.001, 0.5, 2]
    return model


@dataclass(frozen=True)
class Touch:
    """Scoops that came down onto the ground, a tick each.

    Attributes:
        time: [s] since they began to move.
        force: [N] of the ground on the left lower arm, up.
        moment: (ticks, 2) [N m] of it about the left elbow: of the contacts, and felt.
        deflection: [rad] of the left elbow's spring.
        largest: [N] on either arm.
        data, player: at the end.
    """

    time: Array
    force: Array
    moment: Array
    deflection: Array
    largest: float
    data: mujoco.MjData
    player: postures.Player


def touch_down(model: mujoco.MjModel, seconds: float, rest: float = 0.0) -> Touch:
    """Lowers the scoops onto the ground, and waits."""
    data, player = start(model, "rescue", "acquisition")
    player.play([postures.move("settle", 1.0, SP=SHOULDER)])
    sensor = hurcules.SpringForce(hurcules.Robot(model), "LEBS", "L_tcp")
    began, largest = float(data.time), [0.0]
    rows: list[tuple[float, ...]] = []

    def watch() -> None:
        left, right = (contact_moment(model, data, side) for side in "LR")
        sensor.update(data.qpos, data.qvel)
        largest[0] = max(largest[0], left[1], right[1])
        now = data.time - began
        rows.append((now, left[1], left[0], sensor.moment, sensor.deflection))

    player.watch = watch
    player.play([postures.move("down", seconds, hold=0.0, SP=SHOULDER - DOWN)])
    if rest > 0.0:
        player.wait(rest)
    player.watch = None
    log = np.array(rows)
    return Touch(log[:, 0], log[:, 1], log[:, 2:4], log[:, 4], largest[0], data, player)


@cache
def soft() -> Touch:
    """With springs, quickly, then half a second of rest."""
    return touch_down(models.load("rescue"), QUICK, 0.5)


@measures("H14")
def spring_spares() -> Finding:
    """Down onto the ground within 0.8 s, with springs and with rigid elbows."""
    rigid = touch_down(lock(models.load("rescue")), QUICK, 0.5)
    lines = [
        line(name, one.time, one.force, style)
        for name, one, style in (("rigid", rigid, "faint"), ("spring", soft(), "line"))
    ]
    bend = [line("", soft().time, 1e3 * soft().deflection)]
    return Finding(
        {
            "peak": soft().largest / rigid.largest,
            "bend": float(np.abs(soft().deflection).max()),
        },
        [
            Note("peak with springs", soft().largest, "N"),
            Note("peak with rigid elbows", rigid.largest, "N"),
        ],
        [
            Plot("Force of the ground, left", "time [s]", "[N]", lines),
            Plot("Spring of the left elbow", "time [s]", "[mrad]", bend),
        ],
    )


@measures("H15")
def spring_feels() -> Finding:
    """Down within 4 s, then 1.5 s of rest; the moments about each elbow, MuJoCo's and felt."""
    model = models.load("rescue")
    touch = touch_down(model, SLOW, 1.5)
    robot = hurcules.Robot(model)
    off: list[float] = []
    least: list[float] = []
    for side in "LR":
        sensor = hurcules.SpringForce(robot, f"{side}EBS", f"{side}_tcp")
        sensor.update(touch.data.qpos, touch.data.qvel)
        moment, _ = contact_moment(model, touch.data, side)
        off.append(abs(sensor.moment / moment - 1.0))
        least.append(moment)
    moving = np.abs(touch.moment[:, 1] - touch.moment[:, 0])
    lines = [
        line("contacts", touch.time, touch.moment[:, 0]),
        line("felt", touch.time, touch.moment[:, 1], "dashed"),
    ]
    return Finding(
        {"rest": max(off), "moment": min(least)},
        [Note("largest difference while it moves", float(moving.max()), "N m")],
        [Plot("Moment about the left elbow", "time [s]", "[N m]", lines)],
    )
