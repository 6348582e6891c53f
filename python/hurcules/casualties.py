"""What a casualty of models/objects feels: normal forces by region of the body, and by whom.

The sensors of the model add up all contacts of a region; here they are told apart, since a limb
that an arm lifts and a limb that an arm presses to the ground are not the same.
"""

from __future__ import annotations

import mujoco
import numpy as np

from hurcules._core import Error

__all__ = ["contact_forces", "regions"]

TERRAIN = 2  # contact bit, see models/common/classes.xml
PARTNERS = ("ground", "robot", "things")


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
