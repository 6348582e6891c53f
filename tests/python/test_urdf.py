"""Robots out of URDF files: what is read, what is left out, and that they run in the physics."""

from __future__ import annotations

import re
from pathlib import Path

import mujoco
import numpy as np
import pytest

import hurcules

# a shoulder and an elbow; the base has no inertia about z, its mesh is not there, the tool is fixed
FOOT = """<joint name="foot" type="fixed"><parent link="foot"/><child link="base"/></joint>"""
ARM = """
<robot name="arm">
  <link name="base">
    <inertial>
      <mass value="2"/><inertia ixx="0.1" iyy="0.1" izz="0" ixy="0" ixz="0" iyz="0"/>
    </inertial>
    <visual><geometry><mesh filename="package://arm/meshes/base.dae"/></geometry></visual>
    <collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision>
  </link>
  <link name="upper">
    <inertial>
      <origin xyz="0 0 0.2"/><mass value="2"/>
      <inertia ixx="0.03" iyy="0.03" izz="0.01" ixy="0" ixz="0" iyz="0"/>
    </inertial>
    <collision><origin xyz="0 0 0.2"/><geometry><box size="0.1 0.1 0.5"/></geometry></collision>
  </link>
  <link name="lower">
    <inertial>
      <origin xyz="0 0 0.2"/><mass value="1"/>
      <inertia ixx="0.02" iyy="0.02" izz="0.01" ixy="0" ixz="0" iyz="0"/>
    </inertial>
    <collision><origin xyz="0 0 0.2"/><geometry><box size="0.1 0.1 0.9"/></geometry></collision>
  </link>
  <link name="tool"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="60" velocity="1.5"/>
  </joint>
  <joint name="elbow" type="revolute">
    <parent link="upper"/><child link="lower"/><origin xyz="0 0 0.4"/><axis xyz="0 1 0"/>
    <limit lower="0.2" upper="2" effort="30" velocity="2.5"/>
  </joint>
  <joint name="flange" type="fixed">
    <parent link="lower"/><child link="tool"/><origin xyz="0 0 0.4"/>
  </joint>
</robot>
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "arm.urdf"
    path.write_text(ARM)
    return path


def test_limits_and_frames_are_those_of_the_file(file: Path) -> None:
    with pytest.warns(UserWarning, match=r"1 shapes are left out.*base\.dae"):
        model = hurcules.load_urdf(file)
    robot = hurcules.Robot(model)
    shoulder, elbow = robot.coordinates
    assert (shoulder.max_velocity, elbow.max_velocity) == (1.5, 2.5)
    assert (shoulder.max_effort, elbow.max_effort) == (60.0, 30.0)
    assert (elbow.lower, elbow.upper) == (0.2, 2.0)
    robot.set_configuration([0.0, 0.2])
    # 0.4 m up, then 0.4 m along the lower arm
    np.testing.assert_allclose(
        robot.position("tool"), [0.4 * np.sin(0.2), 0.0, 0.4 + 0.4 * np.cos(0.2)], atol=1e-12
    )


def test_its_links_move_in_the_physics_within_their_limits(file: Path) -> None:
    model = hurcules.load_urdf(file, shapes=False)
    assert model.ngeom == 0
    robot = hurcules.Robot(model)
    robot.set_configuration([0.0, 1.2])
    tool = hurcules.PositionTask("tool", robot, "tool", axes=[[1, 0, 0], [0, 0, 1]])
    controller = hurcules.WholeBodyController(robot, [tool], {"tool": hurcules.Twist(tool, 0.5)})
    simulation = hurcules.Simulation(model=model, controller=controller)
    start, second = simulation.data.body("tool").xpos.copy(), round(1 / simulation.dt)
    simulation.step(second, {"tool": [0.1, -0.1]})
    simulation.step(second)
    moved = simulation.data.body("tool").xpos - start
    np.testing.assert_allclose(moved, [0.1, 0.0, -0.1], atol=2e-3)
    assert simulation.limit_violation()["position_rad"] == 0.0


def test_links_that_overlap_by_construction_do_not_touch(file: Path) -> None:
    with pytest.warns(UserWarning):
        model = hurcules.load_urdf(file)
    data = mujoco.MjData(model)
    data.qpos[:] = [0.0, 0.2]  # the lower arm's box reaches into the base
    mujoco.mj_forward(model, data)
    assert data.ncon == 0
    data.qpos[:] = [0.0, 2.0]
    mujoco.mj_forward(model, data)
    assert model.nexclude == 1


def test_motors_are_added_where_there_are_none() -> None:
    spec = mujoco.MjSpec.from_string(
        """<mujoco><worldbody><body><joint name="a"/><geom size="0.1"/>
        <body><joint name="b" type="slide" actuatorfrcrange="-5 3"/><geom size="0.1"/></body>
        </body></worldbody><actuator><position joint="a" kp="1"/></actuator></mujoco>"""
    )
    model = hurcules.with_motors(spec)
    assert [model.actuator(i).name for i in range(model.nu)] == ["", "b"]
    assert model.actuator_forcerange[1].tolist() == [-5.0, 3.0]
    again = hurcules.with_motors(spec)
    assert again.nu == 2


@pytest.mark.parametrize(
    "usual", [
        'ctrllimited="true" ctrlrange="-1 1"',  # motors of 1 N m, in silence
        'ctrllimited="true"',  # "invalid control range for actuator"
        'forcerange="-2 2"',
        'gear="5"',
        'gainprm="1000" biastype="affine" biasprm="0 -1000" dyntype="filter" dynprm="0.1"',
    ],
)  # fmt: skip
def test_motors_are_not_what_a_default_of_the_model_makes_of_its_own(usual: str) -> None:
    text = """<mujoco><default><general {}/></default><worldbody><body>
        <joint name="a" actuatorfrcrange="-50 50"/><geom size="0.1"/>
        <body><joint name="b"/><geom size="0.1"/></body></body></worldbody></mujoco>"""
    plain = hurcules.with_motors(mujoco.MjSpec.from_string(text.format("")))
    model = hurcules.with_motors(mujoco.MjSpec.from_string(text.format(usual)))
    for name in ("ctrllimited", "forcelimited", "forcerange", "gear", "gainprm", "dyntype"):
        of_model, of_plain = (getattr(one, f"actuator_{name}") for one in (model, plain))
        assert np.array_equal(of_model, of_plain), name
    assert model.actuator_forcerange[0].tolist() == [-50.0, 50.0]
    assert not model.actuator_forcelimited[1]


def test_joints_without_a_name_get_motors_too() -> None:
    # "missing transmission target for actuator"
    body = '<body><joint/><geom size="0.1"/>{}</body>'
    text = body.format(body.format("") + body.replace("<joint/>", "").format(body.format("")))
    spec = mujoco.MjSpec.from_string(f"<mujoco><worldbody>{text}</worldbody></mujoco>")
    before = hurcules.Robot(spec.compile()).coordinate_names
    robot = hurcules.Robot(model := hurcules.with_motors(spec))
    assert robot.coordinate_names == before == ["joint0", "joint1", "joint2"]
    assert [model.actuator(i).name for i in range(model.nu)] == before


GRIPPER = """<robot name="gripper"><link name="world"/>
  <joint name="mount" type="revolute"><parent link="world"/><child link="palm"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="20" velocity="2"/></joint>
  <link name="palm">{palm}</link>
  <joint name="left" type="prismatic"><parent link="palm"/><child link="left_finger"/>
    <axis xyz="0 1 0"/><limit lower="0" upper="0.04" effort="20" velocity="0.2"/></joint>
  <link name="left_finger">{finger}</link>
  <joint name="right" type="prismatic"><parent link="palm"/><child link="right_finger"/>
    <axis xyz="0 -1 0"/><limit lower="0" upper="0.04" effort="20" velocity="0.2"/>
    <mimic joint="left"/></joint>
  <link name="right_finger">{finger}</link></robot>"""


def link(mass: float) -> str:
    inertia = " ".join(f'{axis}="{1e-3 * mass}"' for axis in ("ixx", "iyy", "izz"))
    return (
        f'<inertial><mass value="{mass}"/><inertia {inertia} ixy="0" ixz="0" iyz="0"/></inertial>'
    )


def test_a_mimic_joint_stands_where_it_follows_from_the_start(file: Path) -> None:
    # it stood at 0, and sprang to its offset in the first tick
    arm = GRIPPER.replace('<mimic joint="left"/>', '<mimic joint="left" offset="0.01"/>')
    file.write_text(arm.format(palm=link(1.0), finger=link(0.05)))
    robot = hurcules.Robot(hurcules.load_urdf(file))
    assert robot.qpos == pytest.approx([0.0, 0.0, 0.01])


@pytest.mark.parametrize("joints", [["mount"], ["mount", "left"]], ids=["by a rate", "as a task"])
def test_fingers_that_one_joint_leads_have_one_motor_and_go_together(
    file: Path, joints: list[str]
) -> None:
    # with a motor each the second one was held, a Panda's came to 0.029 and 0.001 m
    file.write_text(GRIPPER.format(palm=link(1.0), finger=link(0.05)))
    model = hurcules.load_urdf(file)
    assert [model.actuator(i).name for i in range(model.nu)] == ["mount", "left"]
    robot = hurcules.Robot(model, joints=joints)
    tasks: list[hurcules.Task] = [hurcules.PostureTask("posture", robot, ["mount"])]
    if "left" in joints:
        tasks.append(hurcules.PostureTask("grip", robot, ["left"]))
        grip = hurcules.Twist(tasks[1], 0.05)
    else:
        grip = hurcules.JointRate("left", 0.05)
    controller = hurcules.WholeBodyController(robot, tasks, {"grip": grip})
    simulation = hurcules.Simulation(model=model, controller=controller)
    simulation.step(round(1.0 / simulation.dt), {"grip": [0.03]})
    simulation.step(round(1.0 / simulation.dt))
    assert simulation.data.qpos[1:] == pytest.approx([0.03, 0.03], abs=5e-4)


@pytest.mark.parametrize(
    ("motors", "couplings", "wanted"),
    [
        ("", [("b", "a"), ("c", "a")], ["a"]),
        ("", [("b", "a"), ("c", "b")], ["a"]),
        ("", [("c", "b"), ("b", "a")], ["a"]),
        ("c", [("b", "a"), ("c", "a")], ["c"]),
        ("", [("b", "a"), ("a", "b")], ["a", "c"]),
        ("", [], ["a", "b", "c"]),
    ],
)
def test_joints_that_are_coupled_have_one_motor_together(
    motors: str, couplings: list[tuple[str, str]], wanted: list[str]
) -> None:
    bodies = "".join(f'<body><joint name="{name}"/><geom size="0.1"/></body>' for name in "abc")
    equal = "".join(f'<joint joint1="{one}" joint2="{two}"/>' for one, two in couplings)
    driven = "".join(f'<motor name="{name}" joint="{name}"/>' for name in motors)
    model = hurcules.with_motors(
        mujoco.MjSpec.from_string(
            f"<mujoco><worldbody>{bodies}</worldbody><equality>{equal}</equality>"
            f"<actuator>{driven}</actuator></mujoco>"
        )
    )
    assert [model.actuator(i).name for i in range(model.nu)] == wanted


def test_a_robot_without_motors_is_refused_in_the_physics_alone() -> None:
    text = (
        '<mujoco><worldbody><body><joint name="a"/><geom size="0.1"/></body></worldbody></mujoco>'
    )
    model = mujoco.MjModel.from_xml_string(text)
    robot = hurcules.Robot(model, joints=["a"])
    controller = hurcules.WholeBodyController(robot, [hurcules.PostureTask("posture", robot)])
    with pytest.raises(hurcules.Error, match=r"no joint of the robot has an actuator.*with_motors"):
        hurcules.Simulation(model=model, controller=controller)
    hurcules.Simulation(model=model, controller=controller, physics=False).step(10)


def test_a_planar_base_is_three_coordinates_with_its_limit_of_speed(file: Path) -> None:
    base = """<robot name="base"><link name="ground"/><joint name="wheels" type="planar">
      <parent link="ground"/><child link="foot"/><axis xyz="0 0 1"/>
      <limit effort="300" velocity="0.5"/></joint>"""
    file.write_text(
        base
        + ARM.replace('<robot name="arm">', '<link name="foot"/>', 1).replace(
            '<joint name="flange"', FOOT + '<joint name="flange"', 1
        )
    )
    robot = hurcules.Robot(hurcules.load_urdf(file, shapes=False))
    assert robot.coordinate_names[:3] == ["wheels_TX", "wheels_TY", "wheels_RZ"]
    assert [one.max_velocity for one in robot.coordinates] == [0.5, 0.5, 0.5, 1.5, 2.5]


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("<mujoco/>", "whose root is <robot>; <mujoco> came"),
        ("<robot", "is no XML"),
        (ARM.replace('velocity="1.5"', 'velocity="fast"'), "'shoulder' wants a velocity >= 0"),
        (ARM.replace('ixx="0.1"', 'ixx="much"'), "inertia of link 'base'"),
        (ARM.replace('child link="upper"', 'child link="nobody"'), "arm.urdf"),
        ('<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arm/></robot>', "wants xacro"),
    ],
)
def test_a_file_that_is_none_is_refused(file: Path, text: str, wanted: str) -> None:
    file.write_text(text)
    with pytest.raises(hurcules.Error, match=wanted):
        hurcules.load_urdf(file, shapes=False)


def test_a_text_is_read_as_its_file_is(file: Path) -> None:
    """What xacro gives, or ROS has as `robot_description`."""
    text = '<?xml version="1.0" encoding="utf-8"?>' + ARM
    by_text = hurcules.Robot(hurcules.load_urdf(text, shapes=False))
    by_file = hurcules.Robot(hurcules.load_urdf(file, shapes=False))
    assert by_text.coordinate_names == by_file.coordinate_names
    np.testing.assert_array_equal(by_text.mass_matrix(), by_file.mass_matrix())
    with pytest.raises(hurcules.Error, match="URDF is no XML"):
        hurcules.load_urdf("<robot")


def test_packages_are_found_where_they_are_said_to_be(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    meshes = tmp_path / "share" / "arm" / "meshes"
    meshes.mkdir(parents=True)
    corners, faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n", "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    (meshes / "base.obj").write_text(corners + faces)
    text = ARM.replace("base.dae", "base.obj").replace("visual>", "collision>")
    for variable in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"):
        monkeypatch.delenv(variable, raising=False)
    with pytest.warns(UserWarning, match=r"base\.obj: is not there; packages=\[\.\.\.\] ") as told:
        assert hurcules.load_urdf(text).nmesh == 0
    assert [warning.filename for warning in told] == [__file__]
    for where in (tmp_path / "share", meshes.parent):
        assert hurcules.load_urdf(text, packages=[where]).nmesh == 1
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"/none:{tmp_path}")
    assert hurcules.urdf_spec(text).compile().nmesh == 1
    monkeypatch.delenv("AMENT_PREFIX_PATH")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "share"))
    assert hurcules.load_urdf(text).nmesh == 1
    with pytest.raises(hurcules.Error, match="packages wants a list"):
        hurcules.load_urdf(text, packages="share")


def test_what_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(hurcules.Error, match="cannot read"):
        hurcules.load_urdf(tmp_path / "none.urdf")
    with pytest.raises(hurcules.Error, match="peak wants a number above 0"):
        hurcules.with_motors(mujoco.MjSpec(), peak=0.0)


FLOATING = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.002"/>
  <worldbody>
    <body name="pelvis" pos="0 0 1">
      <freejoint/>
      <geom size="0.15" mass="8"/>
      <body name="trunk">
        <joint name="waist" axis="0 1 0" range="-1 1" limited="true"/>
        <geom type="capsule" fromto="0 0 0 0 0 0.6" size="0.1" mass="30"/>
        <body pos="0 0 0.6">
          <joint name="neck" axis="0 1 0" range="-1 1" limited="true"/>
          <geom fromto="0 0 0 0 0 0.3" type="capsule" size="0.05" mass="5"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="waist"/><motor joint="neck"/></actuator>
</mujoco>"""


def test_a_floating_robot_warns_and_keeps_its_posture_as_it_falls() -> None:
    # for gains of a pelvis that is held the pelvis alone is ninety times too light
    model = mujoco.MjModel.from_xml_string(FLOATING)
    robot = hurcules.Robot(model)
    robot.set_configuration([0.02, 0.3])
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(robot, [posture])
    with pytest.warns(UserWarning, match="root is free, and nothing says what it stands on"):
        simulation = hurcules.Simulation(model=model, controller=controller)
    simulation.step(200)
    assert not simulation.finished
    np.testing.assert_allclose(simulation.data.qpos[7:], [0.02, 0.3], atol=0.03)
    assert np.abs(simulation.data.qvel[6:]).max() < 0.2


RANGE, LIMIT = 'lower="-2" upper="2"', 'effort="60" velocity="1.5"/>'


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (ARM.replace(RANGE, 'lower="0" upper="0"'), "the range of shoulder is empty"),
        (ARM.replace(RANGE, ""), "the range of shoulder is empty"),
        (ARM.replace('effort="60"', 'effort="0"'), "effort of shoulder is 0 and counts as none"),
        (ARM.replace('velocity="1.5"', 'velocity="0"'), "velocity of shoulder is 0 and counts"),
        (ARM.replace(LIMIT, LIMIT + '<mimic joint="hip"/>'), r"not there: shoulder \(hip\)"),
        (ARM.replace(LIMIT, LIMIT + '<mimic joint="flange"/>'), r"not there: shoulder \(flange\)"),
        (GRIPPER.format(palm=link(1.0), finger=""), "what left, right move has no mass"),
    ],
)
def test_what_is_read_otherwise_than_the_file_has_it_is_told(
    file: Path, text: str, told: str
) -> None:
    # a locked joint turned for ever, one that mimics none went its own way, an arm weighed 5 g
    file.write_text(text)
    with pytest.warns(UserWarning, match=told) as caught:
        hurcules.load_urdf(file, shapes=False)
    assert len(caught) == 1
    assert caught[0].filename == __file__


IZZ = ' iyy="0.03" izz="0.01"'  # of the upper arm, about x 0.03


@pytest.mark.parametrize(
    ("izz", "told", "now"),
    [
        ("0.12", r"upper \(0.03 0.03 0.12: now 0.03 0.03 0.06\)", [0.03, 0.03, 0.06]),
        ("-0.01", r"upper \(-0.01 0.03 0.03: now 1e-06 0.03 0.03\)", [1e-6, 0.03, 0.03]),
        ("0.06", "", [0.03, 0.03, 0.06]),  # a plate has it: the sum of the other two
        ("0", "", [1e-6, 0.03, 0.03]),  # a rod
    ],
)
def test_inertias_that_no_body_has_are_told(
    file: Path, izz: str, told: str, now: list[float]
) -> None:
    # they became others in silence: 0.02 kg m^2 of a trunk of Romeo below 0
    text = ARM.replace(IZZ, f' iyy="0.03" izz="{izz}"')
    assert text != ARM
    file.write_text(text)
    if told:
        with pytest.warns(UserWarning, match=f"no body has the principal moments.* {told}: one"):
            model = hurcules.load_urdf(file, shapes=False)
    else:
        model = hurcules.load_urdf(file, shapes=False)  # warnings are errors here
    np.testing.assert_allclose(np.sort(model.body("upper").inertia), now, rtol=1e-6)


def test_of_many_such_links_some_are_named(file: Path) -> None:
    bad = """<link name="bad{0}"><inertial><mass value="1"/>
      <inertia ixx="1" iyy="1" izz="9" ixy="0" ixz="0" iyz="0"/></inertial></link>
      <joint name="to{0}" type="fixed"><parent link="lower"/><child link="bad{0}"/></joint>"""
    links = "".join(bad.format(i) for i in range(9))
    file.write_text(ARM.replace("</robot>", links + "</robot>"))
    with pytest.warns(UserWarning, match=r"bad5 \(1 1 9: now 1 1 2\) and 3 others: one"):
        hurcules.load_urdf(file, shapes=False)


def test_shapes_that_are_left_out_are_told_by_what_they_are_for(file: Path) -> None:
    for text, told in (
        (ARM, "1 shapes are left out (none of them for contacts)"),
        (ARM.replace("visual>", "collision>"), "1 shapes are left out (1 of them for contacts)"),
    ):
        file.write_text(text)
        with pytest.warns(UserWarning, match=re.escape(told)):
            hurcules.load_urdf(file)


def test_a_continuous_joint_has_no_range(file: Path) -> None:
    file.write_text(ARM.replace('"shoulder" type="revolute"', '"shoulder" type="continuous"'))
    shoulder, elbow = hurcules.Robot(hurcules.load_urdf(file, shapes=False)).coordinates
    assert (shoulder.lower, shoulder.upper) == (-np.inf, np.inf)
    assert (shoulder.max_velocity, shoulder.max_effort) == (1.5, 60.0)
    assert (elbow.lower, elbow.upper) == (0.2, 2.0)


def test_a_mimic_joint_bears_what_hangs_on_it(file: Path) -> None:
    # by MuJoCo's own stiffness a hand rested 3 mm off its plan
    elbow = 'effort="30" velocity="2.5"/>'
    file.write_text(ARM.replace(elbow, elbow + '<mimic joint="shoulder" multiplier="0.5"/>'))
    robot = hurcules.Robot(model := hurcules.load_urdf(file, shapes=False))
    robot.set_configuration([1.0])
    controller = hurcules.WholeBodyController(robot, [hurcules.PostureTask("posture", robot)])
    simulation = hurcules.Simulation(model=model, controller=controller)
    simulation.step(1000)
    shoulder, elbow = simulation.data.qpos
    assert elbow == pytest.approx(0.5 * shoulder, abs=1e-4)
