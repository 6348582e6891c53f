"""H01 to H03: mass, heights and degrees of freedom, as MuJoCo reads them from the models."""

from __future__ import annotations

import mujoco
import numpy as np

import hurcules
from hurcules import models
from hurcules_studies.thesis.claim import Finding, Note
from hurcules_studies.thesis.measures.registry import measures

ROBOTS = ("manipulation", "rescue")


@measures("H01")
def mass() -> Finding:
    """Of the robot's tree."""
    values = {}
    for name in ROBOTS:
        model = models.load(name)
        values[name] = float(model.body_subtreemass[model.body("upper_legs").id])
    return Finding(values)


def height(name: str, key: str) -> float:
    """The highest point of the robot's visible geoms over the ground [m]."""
    model = models.load(name)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key(key).id)
    mujoco.mj_forward(model, data)
    root = model.body("upper_legs").id
    top = 0.0
    for geom in range(model.ngeom):
        if model.body_rootid[model.geom_bodyid[geom]] != root:
            continue
        # the box around the geom, in its own axes
        centre, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
        turn = data.geom_xmat[geom].reshape(3, 3)
        top = max(top, float(data.geom_xpos[geom, 2] + turn[2] @ centre + np.abs(turn[2]) @ half))
    return top


@measures("H02")
def heights() -> Finding:
    """In the keyframes ready and drive."""
    return Finding(
        {f"{name}_{key}": height(name, key) for name in ROBOTS for key in ("ready", "drive")}
    )


@measures("H03")
def degrees_of_freedom() -> Finding:
    """What the controller commands."""
    names = {name: hurcules.Robot(models.load(name)).coordinate_names for name in ROBOTS}
    arms = {
        name: {side: sum(one.startswith(side) for one in names[name]) for side in "LR"}
        for name in ROBOTS
    }
    joints = hurcules.Robot(models.load("rescue")).coordinates
    knees = next(len(one.joints) for one in joints if one.name == "KN")
    return Finding(
        {
            "manipulation": len(names["manipulation"]),
            "rescue": len(names["rescue"]),
            # both arms alike, or no whole number
            "manipulation_arm": sum(arms["manipulation"].values()) / 2,
            "rescue_arm": sum(arms["rescue"].values()) / 2,
            "neck": sum(one.startswith("NK") for one in names["manipulation"]),
            "body": sum(one in ("KN", "HIP", "WST") for one in names["manipulation"]),
        },
        [Note("knee joints behind the one coordinate", knees)],
    )
