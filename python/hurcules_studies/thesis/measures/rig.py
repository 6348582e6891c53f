"""A rig for lifting: loads on feet of their own, which the hands take and lift off the ground.

The rig ties a load to the lower arms; how the scoops get under a person, or fingers close around a
handle, is not its matter. The ground bears the load until the arms do. A load of two hands is
welded to the left arm and pinned to the right one, so that the arms do not fight about its
direction.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from hurcules import models, postures
from hurcules_studies.thesis.measures.problems import Array

__all__ = [
    "ARM",
    "Load",
    "acquisition",
    "on_the_scoops",
    "scene",
    "start",
    "take",
    "touching",
]

ARM = {"rescue": "larm", "manipulation": "hand"}
STIFF = [0.004, 1.0]


@dataclass(frozen=True)
class Load:
    """What is lifted: its mass [kg], the hands that do it, and its centre on the ground [m]."""

    mass: float
    hands: str  # "L", "R" or "LR"
    position: tuple[float, float, float]
    foot: bool = True  # it stands on the ground there; else it is held from the start


def _add_load(spec: mujoco.MjSpec, name: str, load: Load) -> None:
    """A box of its mass, and a foot below it that touches the ground alone."""
    body = spec.worldbody.add_body(name=name, pos=load.position)
    body.add_freejoint(name=name)
    box, height = mujoco.mjtGeom.mjGEOM_BOX, load.position[2]
    size = [0.14, 0.8, 0.12] if load.hands == "LR" else [0.08] * 3
    body.add_geom(name=name, type=box, size=size, mass=load.mass, contype=0, conaffinity=0)
    if not load.foot:
        return
    foot = [0.3, 0.3, height / 2]
    body.add_geom(
        name=f"{name}_foot", type=box, size=foot, pos=[0, 0, -height / 2], mass=1e-3,
        contype=0, conaffinity=2,
    )  # fmt: skip


def _add_tie(spec: mujoco.MjSpec, kind: mujoco.mjtEq, first: str, second: str) -> None:
    tie = spec.add_equality(
        name=f"{first}-{second}", type=kind, objtype=mujoco.mjtObj.mjOBJ_BODY,
        name1=first, name2=second, active=False,
    )  # fmt: skip
    tie.solref = STIFF


def scene(robot: str, loads: Mapping[str, Load]) -> mujoco.MjModel:
    """A robot on flat ground and loads, by name."""
    spec = models.parse([models.path(robot), models.path("flat")], "lifting")
    ties = mujoco.mjtEq.mjEQ_WELD, mujoco.mjtEq.mjEQ_CONNECT
    for name, load in loads.items():
        _add_load(spec, name, load)
        for hand, kind in zip(load.hands, ties, strict=False):
            _add_tie(spec, kind, f"{hand}_{ARM[robot]}", name)
    return spec.compile()


def _weld_here(data: mujoco.MjData, tie: Any) -> None:
    """Sets a weld so that it holds its bodies as they are now."""
    first, second = (data.body(int(i)) for i in (tie.obj1id[0], tie.obj2id[0]))
    turn, inverse, relative = first.xmat.reshape(3, 3), np.empty(4), np.empty(4)
    mujoco.mju_negQuat(inverse, first.xquat)
    mujoco.mju_mulQuat(relative, inverse, second.xquat)
    tie.data[:3] = 0
    tie.data[3:6] = turn.T @ (second.xpos - first.xpos)
    tie.data[6:10] = relative


def _pin_here(data: mujoco.MjData, tie: Any, point: Array) -> None:
    """Sets a pin through a point [m] of the world."""
    for at, i in ((0, tie.obj1id[0]), (3, tie.obj2id[0])):
        body = data.body(int(i))
        tie.data[at : at + 3] = body.xmat.reshape(3, 3).T @ (point - body.xpos)


def take(model: mujoco.MjModel, data: mujoco.MjData, robot: str, name: str, hands: str) -> None:
    """The hands take a load."""
    for hand in hands:
        tie = model.equality(f"{hand}_{ARM[robot]}-{name}")
        if tie.type[0] == mujoco.mjtEq.mjEQ_WELD:
            _weld_here(data, tie)
        else:
            _pin_here(data, tie, data.site(f"{hand}_tcp").xpos)
        data.eq_active[tie.id] = 1


def acquisition(robot: str) -> mujoco.MjData:
    """Data of the robot in this keyframe."""
    model = models.load(robot)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("acquisition").id)
    mujoco.mj_forward(model, data)
    return data


def on_the_scoops(along: float = 0.44, above: float = 0.17) -> tuple[float, float, float]:
    """Where a load of two hands lies [m], seen from the elbows and the blades (models/README)."""
    data = acquisition("rescue")
    centres = []
    for side in "LR":
        arm = data.body(f"{side}_larm")
        outward, normal = -arm.xmat.reshape(3, 3)[:, 2], arm.xmat.reshape(3, 3)[:, 0]
        centres.append(arm.xpos + along * outward + above * normal)
    x, y, z = np.mean(centres, axis=0)
    return float(x), float(y), float(z)


def start(
    model: mujoco.MjModel, robot: str, key: str, loads: Sequence[str] = ()
) -> tuple[mujoco.MjData, postures.Player]:
    """Data in a keyframe and its player."""
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key(key).id)
    mujoco.mj_forward(model, data)
    return data, postures.Player(model, data, carried=loads)


def touching(model: mujoco.MjModel, data: mujoco.MjData) -> set[tuple[str, ...]]:
    """Pairs of geoms in contact."""
    mujoco.mj_fwdPosition(model, data)
    pairs = data.contact.geom[: data.ncon]
    return {tuple(sorted(model.geom(int(g)).name for g in pair)) for pair in pairs}
