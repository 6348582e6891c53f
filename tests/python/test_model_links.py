"""Masses, inertias, symmetry and heights of the robots against the tables of the design page.

Source: docs/design/robot.md#links.
"""

import re

import mujoco
import numpy as np
import pytest

from robot_models import ROBOTS, geoms_of, on_flat_ground, place, top_of

# [robot#links] link: mass kg, centre of mass in the link m, inertia kg m2 (x, y, z; yz if any)
LINKS = {
    "upper_legs": (90, (-0.27, 0, 0.03), (2.32, 5.76, 6.90)),
    "battery": (60, (0, 0, 0), (0.56, 1.31, 1.19)),
    "lower_leg_L": (95, (-0.40, 0, 0), (0.80, 10.73, 10.29)),
    "pelvis": (60, (0, 0, 0.02), (0.92, 0.63, 0.87)),
    "waist": (35, (0, 0, 0.13), (0.534, 0.460, 0.600)),
    "torso": (95, (0, 0, 0.24), (3.51, 2.51, 2.07)),
    "backpack": (30, (0, 0, 0), (0.881, 0.650, 0.281)),
    "neck": (4, (0, 0, 0.04), (0.007, 0.007, 0.007)),
    "head": (10, (0.03, 0, 0.12), (0.131, 0.113, 0.113)),
    "L_sh1": (10, (0, 0.05, 0), (0.038, 0.043, 0.038)),
    "L_sh2": (8, (0, 0, -0.05), (0.032, 0.032, 0.030)),
    "L_uarm": (12, (0, 0, -0.14), (0.110, 0.110, 0.039)),
}
# links that the table counts as one
PARTS = {
    "L_hand": ["L_finger_1", "L_finger_2"],
    "upper_legs": ["L_upper_track", "R_upper_track"],
    "lower_leg_L": ["L_lower_track"],
    "transfer_bed": [f"{s}_bed_{i}" for s in "LR" for i in (1, 2)],
}
LOWER_ARMS = {
    "rescue": {
        # with the flange on its inner edge: 1.4 of the 11.5 kg
        "L_larm": (11.5, (0, -0.0135, -0.30), (0.526, 0.499, 0.033), -0.035),
        "transfer_bed": (23, (0, 0, 0), (0.418, 0.261, 0.654)),
    },
    "manipulation": {
        "L_farm": (8, (0, 0, -0.09), (0.036, 0.036, 0.019)),
        "L_wr1": (5, (0, 0, -0.07), (0.016, 0.016, 0.010)),
        "L_wr2": (4, (0, 0, -0.03), (0.007, 0.007, 0.007)),
        "L_hand": (6, (0, 0, -0.07), (0.021, 0.023, 0.012)),  # with its fingers
    },
}


@pytest.fixture(scope="module", params=ROBOTS)
def robot(request):
    return on_flat_ground(request.param)


def composite(model, names):
    """Mass, centre and inertia about it of several bodies together, axes of the first body."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    ids = [model.body(n).id for n in names]
    mass = model.body_mass[ids]
    centre = mass @ data.xipos[ids] / mass.sum()
    inertia = np.zeros((3, 3))
    for i, m in zip(ids, mass, strict=True):
        axes, arm = data.ximat[i].reshape(3, 3), data.xipos[i] - centre
        inertia += axes @ np.diag(model.body_inertia[i]) @ axes.T
        inertia += m * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    frame = data.xmat[ids[0]].reshape(3, 3)
    return mass.sum(), frame.T @ (centre - data.xpos[ids[0]]), frame.T @ inertia @ frame


def test_the_robot_weighs_680_kg(robot):  # [robot#what-the-thesis-gives]
    assert mujoco.mj_getTotalmass(robot[1]) == pytest.approx(680.0, abs=0.05)


def test_links_have_the_mass_centre_and_inertia_of_the_table(robot):
    name, model, _ = robot
    for link, (mass, centre, inertia, *yz) in {**LINKS, **LOWER_ARMS[name]}.items():
        parts = [link, *PARTS.get(link, [])]
        m, c, tensor = composite(model, parts)
        assert m == pytest.approx(mass), link
        assert c == pytest.approx(centre, abs=1e-4), link
        wanted = np.diag(inertia)
        wanted[1, 2] = wanted[2, 1] = sum(yz)
        assert tensor == pytest.approx(wanted, abs=1e-4), link


def test_the_right_side_mirrors_the_left(robot):
    _, model, data = robot
    place(model, data, "ready")
    mirror = np.diag([1, -1, 1])

    def other(n):
        return re.sub("^L", "R", n).replace("leg_L", "leg_R")

    left = [n for n in (model.body(i).name for i in range(model.nbody)) if other(n) != n]
    assert len(left) >= 9
    for n in left:
        a, b = data.body(n), data.body(other(n))
        assert b.xipos == pytest.approx(mirror @ a.xipos, abs=1e-9), n

        def tensor(d, k):
            return d.ximat.reshape(3, 3) @ np.diag(model.body(k).inertia) @ d.ximat.reshape(3, 3).T

        assert tensor(b, other(n)) == pytest.approx(mirror @ tensor(a, n) @ mirror, abs=1e-9), n
        if "_bed_" in n:  # their plates lie above each other
            continue
        for mine, its in zip(geoms_of(model, n), geoms_of(model, other(n)), strict=True):
            mesh = model.geom_type[mine] == mujoco.mjtGeom.mjGEOM_MESH
            near = 1e-3 if mesh else 1e-9  # meshes are rounded and turned rather than mirrored
            assert model.geom_size[its] == pytest.approx(model.geom_size[mine], abs=near)
            assert data.geom_xpos[its] == pytest.approx(mirror @ data.geom_xpos[mine], abs=near)


# [robot#what-the-thesis-gives]
@pytest.mark.parametrize("key, height", [("drive", 1.678), ("ready", 1.900)])
def test_the_robot_is_as_high_as_published(robot, key, height):
    _, model, data = robot
    place(model, data, key)
    assert top_of(model, data) == pytest.approx(height, abs=0.005)
