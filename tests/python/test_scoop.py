"""The scoops of the rescue arms: a thin wedge that slides, as drawn and as it touches.

Strategy: the corners of the contact hulls against the numbers of models/README.md; looks against
hulls, corner by corner; the friction that a contact gets; the claim K20 in the physics, a person of
75 kg. Not tested: other persons and places under the body.
"""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from hurcules import models, scenes
from hurcules_studies.thesis.measures.force_casualty import HIGH, scoop

TIP, BOTTOM = -0.70, -0.018  # [m] in the frame of the lower arm: edge, lower face
PLASTIC = 0.2  # friction of UHMW polyethylene


def corners(model: mujoco.MjModel, geom: int) -> np.ndarray:
    """Vertices of a mesh in the frame of its body, (n, 3) [m]."""
    mesh = model.geom_dataid[geom]
    begin, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, model.geom_quat[geom])
    vertices = model.mesh_vert[begin : begin + count]
    return np.asarray(vertices @ turn.reshape(3, 3).T + model.geom_pos[geom])


def meshes(model: mujoco.MjModel, *names: str) -> np.ndarray:
    """Vertices of all geoms on the left lower arm that show one of these meshes."""
    arm = model.body("L_larm").id
    wanted = {model.mesh(name).id for name in names}
    found = [g for g in range(model.ngeom) if model.geom_bodyid[g] == arm]
    found = [g for g in found if model.geom_dataid[g] in wanted]
    assert len(found) == len(names)
    return np.concatenate([corners(model, g) for g in found])


@pytest.fixture(scope="module")
def robot() -> mujoco.MjModel:
    return models.load("rescue")


def test_the_contact_hulls_are_one_thin_wedge(robot: mujoco.MjModel) -> None:
    hull = meshes(robot, "scoop_blade_hull", "scoop_tip_hull")
    assert hull[:, 2].min() == pytest.approx(TIP, abs=1e-6)
    assert hull[:, 0].min() == pytest.approx(BOTTOM, abs=1e-6)
    upper = hull[hull[:, 0] > BOTTOM + 1e-3]
    edge = upper[upper[:, 2] < TIP + 1e-6]
    assert edge[:, 0] - BOTTOM == pytest.approx(0.002, abs=1e-5)
    root = upper[upper[:, 2] > -0.2]
    assert root[:, 0] - BOTTOM == pytest.approx(0.036, abs=1e-5)
    rise = np.arctan2(upper[:, 0] - edge[0, 0], upper[:, 2] - TIP)[upper[:, 2] > TIP + 0.01]
    assert np.degrees(rise) == pytest.approx(3.6, abs=0.1)


def test_what_is_drawn_is_what_touches(robot: mujoco.MjModel) -> None:
    for hull, *looks in (
        ("scoop_blade_hull", "scoop_blade"),
        ("scoop_tip_hull", "scoop_tip"),
        ("scoop_flange_hull", "scoop_flange"),
    ):
        mine, seen = meshes(robot, hull), meshes(robot, *looks)
        top = mine[:, 0].max()
        assert seen.min(axis=0) == pytest.approx(mine.min(axis=0), abs=0.001)
        assert seen[:, 1].max() == pytest.approx(mine[:, 1].max(), abs=0.001)
        assert top - 0.002 < seen[:, 0].max() < top  # the liner lies on it
    liner = meshes(robot, "scoop_liner")
    both = meshes(robot, "scoop_blade_hull", "scoop_tip_hull")
    assert liner[:, [0, 2]].max(axis=0) == pytest.approx([0.018, -0.16], abs=1e-4)
    assert liner[:, 2].min() == pytest.approx(both[:, 2].min(), abs=1e-4)


def test_the_flange_widens_the_wedge_on_its_inner_edge(robot: mujoco.MjModel) -> None:
    flange, blade = meshes(robot, "scoop_flange_hull"), meshes(robot, "scoop_blade_hull")
    assert flange[:, 1].min() == pytest.approx(
        -0.18, abs=1e-6
    )  # the robot's middle is on the right
    assert flange[:, 2].max() == pytest.approx(-0.34, abs=1e-6)
    assert flange[:, 2].min() == pytest.approx(TIP, abs=1e-6)
    # its upper face goes on where the blade's is, to 0.2 mm
    low, high = np.array([-0.0085, -0.58]), np.array([0.018, -0.16])
    upper = flange[(flange[:, 0] > BOTTOM + 1e-3) & (flange[:, 2] > -0.6)]
    along = (upper[:, 2] - low[1]) / (high[1] - low[1])
    assert upper[:, 0] == pytest.approx(low[0] + along * (high[0] - low[0]), abs=2e-4)
    assert blade[:, 1].min() == pytest.approx(-0.06, abs=1e-6)
    right = robot.geom("R_scoop_flange").dataid[0]
    begin = robot.mesh_vertadr[right]
    assert robot.mesh_vertnum[right] == len(flange) and begin > 0


def test_the_plastic_decides_the_friction_on_cloth() -> None:
    model = scenes.load("casualty", robot="rescue")
    data = mujoco.MjData(model)
    chest = model.geom("casualty_ribs_back").id
    for part in ("blade", "tip", "flange"):
        mine = model.geom(f"L_scoop_{part}").id
        assert model.geom_priority[mine] > model.geom_priority[chest]
        assert model.geom_friction[mine, 0] == PLASTIC
    # the tip is laid into the chest, and the contact is asked
    mujoco.mj_kinematics(model, data)
    root = model.joint("casualty_root").qposadr[0]
    data.qpos[root : root + 3] += data.site("L_tcp").xpos - data.geom("casualty_ribs_back").xpos
    mujoco.mj_forward(model, data)
    frictions = [
        contact.friction[0]
        for contact in data.contact[: data.ncon]
        if {model.geom("L_scoop_tip").id, chest} == set(contact.geom.tolist())
    ]
    assert frictions
    assert frictions == [PLASTIC] * len(frictions)


def test_pressing_tips_go_under_a_person_and_others_push_it_away() -> None:  # K20 [T 5.7.2]
    assert scoop().pushed < 0.25  # 0.12
    assert scoop(HIGH).pushed > 0.8  # 0.94
