"""Whether the robot stands free where it starts."""

from __future__ import annotations

import mujoco

from hurcules._core import Error

__all__ = ["require_clear"]

DEEPEST = 2e-3  # [m] tracks sink in by 0.1 mm, on bumps a little more


def require_clear(model: mujoco.MjModel, scene: str) -> None:
    """Checks the keyframe `home`.

    Raises:
        Error: two things overlap there; the text names both, and by how much.
    """
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
    mujoco.mj_fwdPosition(model, data)
    for contact in data.contact[: data.ncon]:
        if contact.dist < -DEEPEST:
            one, other = (_title(model, int(geom)) for geom in contact.geom)
            depth = -1e3 * contact.dist
            raise Error(f"{scene}: '{one}' and '{other}' overlap by {depth:.1f} mm at the start")


def _title(model: mujoco.MjModel, geom: int) -> str:
    return model.geom(geom).name or model.body(int(model.geom_bodyid[geom])).name
