"""What a casualty of models/objects feels: normal forces by region of the body, and by whom.

The sensors of the model add up all contacts of a region; here they are told apart, since a limb
that an arm lifts and a limb that an arm presses to the ground are not the same.
"""

from __future__ import annotations

import mujoco
import numpy as np

from hurcules._core import Error

__all__ = ["CARRIES", "contact_forces", "contact_limit", "regions"]

TERRAIN = 2  # contact bit, see models/common/classes.xml
PARTNERS = ("ground", "robot", "things")
CARRIES = 0.15  # share of the weight on the ground, up to which forces of the robot carry
# [N] of a contact, ISO/TS 15066 Annex A [test-methods#contact-limits]; as casualty_monitor.cpp has
LIMITS = {
    "skull": 130.0, "face": 65.0, "neck": 150.0, "upper_back": 210.0, "lower_back": 210.0,
    "chest": 140.0, "belly": 110.0, "pelvis": 180.0, "upper_arm": 150.0, "forearm": 160.0,
    "hand": 140.0, "thigh": 220.0, "shank": 130.0, "foot": 130.0,
}  # fmt: skip


def regions(model: mujoco.MjModel, prefix: str = "casualty_") -> list[str]:
    """Returns the regions of the body that are measured.

    Args:
        model: has a casualty in it.
        prefix: what stands before all its names.

    Raises:
        Error: no casualty with this prefix.
    """
    start = f"{prefix}force_"
    names = [model.sensor(i).name for i in range(model.nsensor)]
    found = [name.removeprefix(start) for name in names if name.startswith(start)]
    if not found:
        raise Error(f"no casualty with the prefix '{prefix}': no sensor begins with '{start}'")
    return found


def contact_limit(region: str) -> float:
    """The largest force of a contact with a region [N], "L_thigh" or "skull"; inf for others."""
    return next((limit for name, limit in LIMITS.items() if region.endswith(name)), np.inf)


def contact_forces(
    model: mujoco.MjModel, data: mujoco.MjData, prefix: str = "casualty_"
) -> dict[str, dict[str, float]]:
    """Adds up the normal forces on each region as they are now.

    Args:
        model: has a casualty in it.
        data: after a step.
        prefix: what stands before all the casualty's names.

    Returns:
        For each region the normal force [N] from the ground, the robot, and other things.

    Raises:
        Error: no casualty with this prefix.
    """
    forces = {name: dict.fromkeys(PARTNERS, 0.0) for name in regions(model, prefix)}
    wrench = np.zeros(6)
    for i in range(data.ncon):
        mine = [_region(model, int(geom), prefix) for geom in data.contact[i].geom]
        if data.contact[i].efc_address < 0 or not any(mine):
            continue
        mujoco.mj_contactForce(model, data, i, wrench)
        for side, region in enumerate(mine):
            if region:
                other = int(data.contact[i].geom[1 - side])
                forces[region][_partner(model, other)] += float(wrench[0])
    return forces


def _region(model: mujoco.MjModel, geom: int, prefix: str) -> str:
    """The casualty's body that a geom belongs to, "" for none: regions are named after bodies."""
    name = model.body(int(model.geom_bodyid[geom])).name
    return name.removeprefix(prefix) if name.startswith(prefix) else ""


def _partner(model: mujoco.MjModel, geom: int) -> str:
    if model.geom_contype[geom] == TERRAIN:
        return "ground"
    root = model.body(int(model.body_rootid[model.geom_bodyid[geom]])).name
    return "robot" if root == "upper_legs" else "things"
