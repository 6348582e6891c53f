"""F07: what the camera on the head sees of a rescue."""

from __future__ import annotations

import mujoco
import numpy as np

import hurcules
from hurcules import cameras
from hurcules_studies.thesis.claim import Finding, Note
from hurcules_studies.thesis.measures.registry import measures

CAMERA = "head_wide"
ACROSS, DOWN = 48, 36  # rays through a picture
# where each step of Figure 4.29 begins in the mission `lift`
STEPS = {"ready": "stand", "acquisition": "under", "lifting": "lift"}
NECK = ("NKY", "NKP")
PERSON, ROBOT = "casualty_", "robot"


def seen(model: mujoco.MjModel, data: mujoco.MjData) -> dict[str, float]:
    """Shares of the picture that show the person and the robot itself.

    Args:
        model: of the scene.
        data: after mj_kinematics and mj_camlight.
    """
    camera = cameras.find(model, CAMERA)
    number = model.camera(camera.name).id
    turn = data.cam_xmat[number].reshape(3, 3)
    columns, rows = np.meshgrid(
        (np.arange(ACROSS) + 0.5) / ACROSS * camera.width,
        (np.arange(DOWN) + 0.5) / DOWN * camera.height,
    )
    pixels = np.stack([columns.ravel(), rows.ravel(), np.ones(columns.size)])
    # x right, y down, z along the view; a camera of MuJoCo looks along -z, y up
    rays = turn @ (np.linalg.solve(camera.intrinsics, pixels) * [[1.0], [-1.0], [-1.0]])
    shares = dict.fromkeys((PERSON, ROBOT), 0.0)
    geom = np.zeros(1, np.int32)
    for ray in rays.T:
        head = model.cam_bodyid[number]
        mujoco.mj_ray(model, data, data.cam_xpos[number], ray, None, 1, head, geom)
        if geom[0] < 0:
            continue
        body = model.geom_bodyid[geom[0]]
        if model.body(body).name.startswith(PERSON):
            shares[PERSON] += 1.0 / columns.size
        elif model.body_rootid[body] == model.body_rootid[head]:
            shares[ROBOT] += 1.0 / columns.size
    return shares


def seen_straight_ahead(model: mujoco.MjModel, data: mujoco.MjData) -> dict[str, float]:
    """The same with a neck that is not turned."""
    still = mujoco.MjData(model)
    still.qpos[:] = data.qpos
    for joint in NECK:
        still.joint(joint).qpos[0] = 0.0
    mujoco.mj_kinematics(model, still)
    mujoco.mj_camlight(model, still)
    return seen(model, still)


@measures("F07")
def the_head_sees_what_is_done() -> Finding:
    """The mission `lift`, 75 kg; the same pictures with a neck that is not turned."""
    simulation = hurcules.Simulation("lift", 1, variation=0.0, record=False)
    views, ahead = {}, {}
    for step, phase in STEPS.items():
        while not simulation.finished and simulation.phase != phase:
            simulation.step(20)
        views[step] = seen(simulation.model, simulation.data)
        ahead[step] = seen_straight_ahead(simulation.model, simulation.data)
    found = {step: view[PERSON] for step, view in views.items()}
    return Finding(
        {
            **found,
            "arms": views["acquisition"][ROBOT],
            "ahead": max(view[PERSON] for view in ahead.values()),
        },
        [Note(f"own arms in the picture, {step}", view[ROBOT]) for step, view in views.items()],
    )
