"""One MJCF file without includes: it loads alone, stands by its own servos, and fits MJX.

Strategy: what is written is read back by MuJoCo and compared with the model it came from. Not
tested here: that other programs read it (docs: models/README.md says which did).
"""

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules.cli import main
from hurcules.export import export

ROBOTS = hurcules.models.names()


@pytest.mark.parametrize("robot", ROBOTS)
def test_the_file_alone_is_the_same_model(robot, tmp_path):
    path = export(tmp_path / "robot.xml", robot)
    assert "<include" not in path.read_text()
    read, ours = mujoco.MjModel.from_xml_path(str(path)), hurcules.models.load(robot)
    assert (read.nq, read.nu, read.ngeom, read.nsensor) == (
        ours.nq, ours.nu, ours.ngeom, ours.nsensor
    )  # fmt: skip
    np.testing.assert_allclose(read.body_mass, ours.body_mass, rtol=1e-6)
    np.testing.assert_allclose(read.key_qpos, ours.key_qpos, atol=1e-5)  # six digits
    data, reference = mujoco.MjData(read), mujoco.MjData(ours)
    mujoco.mj_step(read, data, 20)
    mujoco.mj_step(ours, reference, 20)
    np.testing.assert_allclose(data.qpos, reference.qpos, atol=1e-5)


@pytest.mark.slow
@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("key", [None, "ready"])
def test_by_position_servos_it_stands_for_a_minute_under_plain_mj_step(robot, key, tmp_path):
    path = export(tmp_path / "robot.xml", robot, actuators="position")
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    if key:
        mujoco.mj_resetDataKeyframe(model, data, model.key(key).id)
    mujoco.mj_forward(model, data)
    head = data.body("head").xpos.copy()
    mujoco.mj_step(model, data, 60000)
    assert np.linalg.norm(data.body("head").xpos - head) < 0.02
    assert not any(warning.number for warning in data.warning)


@pytest.mark.parametrize("robot", ROBOTS)
def test_what_mjx_does_not_take_is_left_out(robot, tmp_path):
    model = mujoco.MjModel.from_xml_path(str(export(tmp_path / "robot.xml", robot, mjx=True)))
    assert not (model.sensor_type == mujoco.mjtSensor.mjSENS_CONTACT).any()
    plane, cylinder = mujoco.mjtGeom.mjGEOM_PLANE, mujoco.mjtGeom.mjGEOM_CYLINDER
    meets = (model.geom_contype[:, None] & model.geom_conaffinity[None]) != 0
    meets |= meets.T
    kinds = model.geom_type[meets[model.geom_type == cylinder].any(axis=0)]
    assert set(kinds.tolist()) == {int(plane)}


def test_a_name_that_nothing_has_is_one_line(tmp_path, capsys):
    out = ["--out", str(tmp_path / "robot.xml")]
    assert main(["export", "rescue", "--actuators", "muscle", *out]) == 2
    assert "kind of actuators 'muscle' does not exist" in capsys.readouterr().err
    assert main(["export", "forklift", *out]) == 2
    assert not (tmp_path / "robot.xml").exists()


def test_the_command_writes_the_file(tmp_path, capsys):
    path = tmp_path / "deep" / "robot.xml"
    assert main(["export", "manipulation", "--out", str(path)]) == 0
    assert capsys.readouterr().out.strip() == str(path)
    assert (path.parent / "assets" / "head.obj").is_file()
