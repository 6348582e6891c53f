"""Stacks by torques, and robots that float: from Python, on a URDF and on a quadruped."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

import hurcules

LINK = """<link name="{name}"><inertial><mass value="2"/>
  <inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><geometry><box size="0.2 0.1 0.04"/></geometry></collision></link>"""
URDF = f"""<robot name="hinge">{LINK.format(name="foot")}{LINK.format(name="top")}
  <joint name="knee" type="revolute"><parent link="foot"/><child link="top"/><origin xyz="0 0 0.1"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="30" velocity="3"/></joint></robot>"""
QUADRUPED = hurcules.models.folder() / "examples" / "quadruped.xml"


@pytest.fixture
def urdf(tmp_path: Path) -> Path:
    path = tmp_path / "hinge.urdf"
    path.write_text(URDF)
    return path


def quadruped() -> hurcules.Robot:
    robot = hurcules.Robot(QUADRUPED, floating=True)
    robot.set_keyframe("stand")
    return robot


def test_a_urdf_stands_on_a_floor_on_its_sole(urdf: Path) -> None:
    model = hurcules.load_urdf(urdf, floating=True)
    assert (model.nq, model.nv, model.nu) == (8, 7, 1)
    assert model.qpos0[2] == pytest.approx(0.02 - 5e-4)  # half a box, 0.5 mm in the floor
    robot = hurcules.Robot(model, floating=True)
    sole = hurcules.sole_points(robot, "foot")
    assert sole.shape == (4, 3)
    assert np.abs(sole) == pytest.approx(np.tile([0.1, 0.05, 0.02], (4, 1)))
    foot = hurcules.ContactTask("foot", robot, "foot")
    assert np.abs(foot.points) == pytest.approx(np.tile([0.09, 0.045, 0.02], (4, 1)))
    posture = hurcules.PostureTask("posture", robot)
    assert posture.rows == 1  # the knee, not the root
    controller = hurcules.WholeBodyController(robot, [foot, posture], control="torque")
    simulation = hurcules.Simulation(model=model, controller=controller)
    simulation.step(500)
    assert np.abs(simulation.data.qvel).max() < 1e-3
    assert controller.contact_force("foot")[2] == pytest.approx(4 * 9.81, abs=0.05)
    pressed = model.qpos0.copy()
    pressed[7] = 1.0
    assert hurcules.on_floor(model, pressed, depth=0.0)[2] == pytest.approx(0.02)


def test_on_floor_says_what_it_wants(urdf: Path) -> None:
    model = hurcules.load_urdf(urdf, floating=True)
    with pytest.raises(hurcules.Error, match="'ground' is none"):
        hurcules.on_floor(model, model.qpos0, "ground")
    with pytest.raises(hurcules.Error, match="name of a plane"):
        hurcules.on_floor(hurcules.load_urdf(urdf), np.zeros(1))
    with pytest.raises(hurcules.Error, match="no geom of the robot"):
        hurcules.load_urdf(urdf, shapes=False, floating=True)


def test_a_robot_that_floats_wants_torques_and_contacts() -> None:
    robot = quadruped()
    assert robot.size == 21
    assert robot.coordinate_names[0] == "root_x"
    posture = hurcules.PostureTask("posture", robot)
    with pytest.raises(hurcules.Error, match="wants the order 'torque'"):
        hurcules.WholeBodyController(robot, [posture])
    with pytest.raises(hurcules.Error, match="root of the robot floats"):
        hurcules.WholeBodyController(robot, [posture], control="torque")
    with pytest.raises(hurcules.Error, match="free joint at its root"):
        hurcules.Robot(
            mujoco.MjModel.from_xml_string(
                "<mujoco><worldbody><body><joint name='j'/><geom size='.1'/></body></worldbody>"
                "</mujoco>"
            ),
            floating=True,
        )


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"body": "hoof"}, "'hoof'"),
        ({"body": "hand"}, "wants a body"),
        ({"friction": 0.0}, "friction > 0"),
        ({"normal": [0.0, 0.0, 0.0]}, "normal"),
        ({"points": [[0.0, np.nan, 0.0]]}, "finite"),
    ],
)
def test_a_contact_says_what_it_wants(options: dict, text: str) -> None:
    with pytest.raises(hurcules.Error, match=text):
        hurcules.ContactTask("c", quadruped(), **{"body": "FL_shank", **options})


def test_the_controller_gives_torques_without_a_simulation() -> None:
    robot = quadruped()
    legs = ("FL", "FR", "HL", "HR")
    feet = [hurcules.ContactTask(leg, robot, f"{leg}_shank") for leg in legs]
    com = hurcules.CenterOfMassTask("com", robot)
    controller = hurcules.AccelerationController(robot)
    controller.set_stack(hurcules.Stack([feet, com]))
    controller.compute(robot)
    torque = controller.torque(robot)
    assert np.abs(torque[:6]).max() < 1e-6
    assert np.abs(torque[6:]).max() > 1.0
    carried = sum(controller.contact_force(foot) for foot in feet)
    assert carried == pytest.approx([0.0, 0.0, 9.81 * 16.0], abs=1e-6)


def test_a_fallen_robot_asks_for_no_torque_beyond_its_limits_and_says_what_yields() -> None:
    robot = quadruped()
    model = mujoco.MjModel.from_xml_path(str(QUADRUPED))
    data = mujoco.MjData(model)
    data.qpos[:] = robot.qpos
    data.qpos[2:7] = [0.25, np.sqrt(0.5), np.sqrt(0.5), 0.0, 0.0]  # on its side
    feet = [hurcules.ContactTask(leg, robot, f"{leg}_shank") for leg in ("FL", "FR", "HL", "HR")]
    com = hurcules.CenterOfMassTask("com", robot)
    controller = hurcules.AccelerationController(
        robot, hurcules.AccelerationControllerOptions(dt=model.opt.timestep)
    )
    controller.set_stack(hurcules.Stack([feet, com, hurcules.PostureTask("posture", robot)]))
    limits = np.array([coordinate.max_effort for coordinate in robot.coordinates[6:]])
    motors = [coordinate.joints[0].actuator for coordinate in robot.coordinates[6:]]
    told = set()
    for tick in range(1000):
        robot.set_qpos(data.qpos)
        robot.set_velocity(data.qvel)
        controller.compute(robot)
        torque = controller.torque(robot)[6:]
        assert (np.abs(torque) <= limits).all()
        if tick % 50 == 0:
            for level in controller.diagnostics(robot):
                told.update(short.task for short in level.shortfalls)
        data.ctrl[motors] = torque
        mujoco.mj_step(model, data)
    assert told & {"FL", "FR", "HL", "HR"}
