"""What the lower arms of the rescue robot press on: the floor, plates on springs, or a person.

A sensor for each lower arm adds up all its contacts, so that what is pressed can be told from what
the elbow's spring says of it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import mujoco

from hurcules import models, scenes

__all__ = ["Surface", "model_of"]

PLATE_MASS = 5.0  # [kg]
PLATE = (0.8, 0.2, 0.02)  # [m] half sizes
PLATE_TOP = 0.02  # [m] above the floor, which it does not touch
SLIDING = 2.0  # [s]
# a joint that a brake holds
LOCK_SOLREF, LOCK_SOLIMP, LOCK = (0.004, 1.0), (0.9999, 0.9999, 0.001, 0.5, 2.0), 1e5


@dataclass(frozen=True)
class Surface:
    """What is under the hands, and how the elbows are made.

    Attributes:
        stiffness: [N/m] of a plate under each hand; 0: the floor.
        springs: whether the elbows have theirs; else they are rigid.
        friction: of the lower arms on the ground: with grit, more than the 0.2 of their plastic.
        casualty: [kg] of a person who lies ahead; 0: nobody.
        distance: [m] of that person's middle from the knee axis.
        untouched: the arms pass through the floor as if there were none.
    """

    stiffness: float = 0.0
    springs: bool = True
    friction: float = 0.35
    casualty: int = 0
    distance: float = 2.0
    untouched: bool = False


def model_of(surface: Surface) -> mujoco.MjModel:
    """The rescue robot on it."""
    if surface.casualty:
        spec = scenes.make(
            "casualty", robot="rescue", mass=surface.casualty, distance=surface.distance
        )
    else:
        spec = models.parse([models.path("rescue"), models.path("flat")])
    for side, y in (("L", 0.33), ("R", -0.33)):
        if surface.stiffness:
            _add_plate(spec, f"{side}_plate", (1.9, y, PLATE_TOP), surface.stiffness)
        _add_sensor(spec, f"{side}_press", f"{side}_larm")
        ground = f"{side}_plate" if surface.stiffness else "floor"
        for part in ("blade", "tip", "flange"):
            if surface.untouched:
                spec.geom(f"{side}_scoop_{part}").conaffinity = 0
                spec.geom(f"{side}_scoop_{part}").contype = 0
            else:
                _add_pair(spec, f"{side}_scoop_{part}", ground, surface.friction)
    model = spec.compile()
    if not surface.springs:
        for side in "LR":
            _lock(model, f"{side}EBS")
    return model


def _add_plate(
    spec: mujoco.MjSpec, name: str, top: tuple[float, float, float], stiffness: float
) -> None:
    """A weightless plate that gives way downward, its upper face at `top`, damped by 0.7."""
    half = PLATE[2]
    body = spec.worldbody.add_body(name=name, pos=[top[0], top[1], top[2] - half], gravcomp=1.0)
    damping = 1.4 * math.sqrt(stiffness * PLATE_MASS)
    body.add_joint(
        name=name,
        type=mujoco.mjtJoint.mjJNT_SLIDE,
        axis=[0, 0, 1],
        stiffness=stiffness,
        damping=damping,
    )
    # touches the robot's body alone: bit 4 in models/common/classes.xml
    body.add_geom(
        name=name,
        type=mujoco.mjtGeom.mjGEOM_BOX,
        size=PLATE,
        mass=PLATE_MASS,
        contype=0,
        conaffinity=4,
        rgba=[0.35, 0.45, 0.30, 1.0],
    )


def _add_pair(spec: mujoco.MjSpec, arm: str, ground: str, friction: float) -> None:
    """Contact of an arm with the ground.

    MuJoCo's friction pushes a thing off that slides fast for its load: with the usual time constant
    a tip under 5 N hops. A slow one for friction alone leaves Coulomb's force and no hops.
    """
    sliding = [friction, friction, 0.005, 1e-4, 1e-4]
    spec.add_pair(
        name=f"{arm}_on_{ground}",
        geomname1=arm,
        geomname2=ground,
        condim=3,
        friction=sliding,
        solreffriction=[SLIDING, 1.0],
    )


def _add_sensor(spec: mujoco.MjSpec, name: str, body: str) -> None:
    """Number of contacts of a body, then their force on what it touches, world axes."""
    sensor = spec.add_sensor(
        name=name,
        type=mujoco.mjtSensor.mjSENS_CONTACT,
        objtype=mujoco.mjtObj.mjOBJ_BODY,
        objname=body,
    )
    found, force = mujoco.mjtConDataField.mjCONDATA_FOUND, mujoco.mjtConDataField.mjCONDATA_FORCE
    sensor.intprm[:3] = [(1 << int(found)) | (1 << int(force)), 3, 1]  # data, net force, one of it


def _lock(model: mujoco.MjModel, joint: str) -> None:
    dof = model.joint(joint).dofadr[0]
    model.dof_frictionloss[dof] = LOCK
    model.dof_solref[dof], model.dof_solimp[dof] = LOCK_SOLREF, LOCK_SOLIMP
