"""What users' own robots have and ours have not.

Strategy: each is a robot of one or two joints on which a newcomer met a wrong result in silence;
what must hold is reckoned by hand or read from the physics.
"""

import copy
import pickle
import warnings
from pathlib import Path

import mujoco
import numpy as np
import pytest

import hurcules

ARM = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.001"/>
  <default>
    <joint axis="0 0 1" damping="0.3" armature="0.05" range="-2.8 2.8" limited="true"/>
    <geom contype="0" conaffinity="0" density="900" type="capsule" size="0.04"/>
  </default>
  <asset><hfield name="hills" nrow="2" ncol="2" size="1 1 0.2 0.1" elevation="0 1 1 0"/></asset>
  <worldbody>
    <geom name="ground" type="hfield" hfield="hills" contype="{ground}"/>
    <body name="upper" pos="0 0 1">
      <joint name="a"/><geom fromto="0 0 0 0.4 0 0"/>
      <body name="lower" pos="0.4 0 0">
        <joint name="b"/><geom name="hand" fromto="0 0 0 0.4 0 0" conaffinity="{ground}"/>
        <site name="tip" pos="0.4 0 0"/>
      </body>
    </body>
  </worldbody>
  <actuator>{actuators}</actuator>
</mujoco>"""
MOTORS = '<motor joint="a" ctrlrange="-20 20"/><motor joint="b" ctrlrange="-20 20"/>'


def loop(actuators: str = MOTORS, **options) -> tuple[hurcules.Simulation, hurcules.PostureTask]:
    model = mujoco.MjModel.from_xml_string(ARM.format(actuators=actuators, ground=0))
    robot = hurcules.Robot(model)
    robot.set_configuration([0.0, 1.2])
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(robot, [posture], **options)
    return hurcules.Simulation(model=model, controller=controller), posture


def test_coordinates_that_only_tendons_move_are_named() -> None:
    text = ARM.format(actuators='<motor joint="a"/><motor tendon="pull"/>', ground=0)
    tendon = '<tendon><fixed name="pull"><joint joint="b" coef="1"/></fixed></tendon></mujoco>'
    model = mujoco.MjModel.from_xml_string(text.replace("</mujoco>", tendon))
    robot = hurcules.Robot(model, ["a", "b"])
    controller = hurcules.WholeBodyController(robot, [hurcules.PostureTask("posture", robot)])
    with pytest.warns(UserWarning, match="^b: moved by actuators of tendons alone"):
        hurcules.Simulation(model=model, controller=controller)


@pytest.mark.parametrize("control", ["velocity", "acceleration", "torque"])
def test_one_actuator_bears_a_joint_that_has_several(control: str) -> None:
    actuators = (
        '<position joint="a" kp="200" name="place"/><velocity joint="a" kv="20" name="rate"/>'
        '<motor joint="b"/><motor joint="b" gear="2"/>'
    )
    with pytest.warns(UserWarning, match="alone: 'a' by place, not by rate; 'b' by number 2"):
        simulation, posture = loop(actuators, control=control)
    posture.set_target([-0.8, 0.9])
    simulation.step(4000)
    assert simulation.data.qpos == pytest.approx([-0.8, 0.9], abs=1e-4)
    assert np.abs(simulation.data.actuator_force).max() < 1.0  # they do not press on each other


def test_a_push_beyond_the_motors_leaves_accelerations_within_their_limit() -> None:
    # what is fed forward asked for more each tick: 7e15 rad/s
    simulation, _ = loop(control="acceleration")
    limit = 20.0 * simulation.dt
    before = simulation.controller.qd_des.copy()
    for tick in range(2000):
        simulation.data.xfrc_applied[2, 1] = 200.0 if 300 <= tick < 800 else 0.0
        simulation.step()
        now = simulation.controller.qd_des.copy()
        assert np.abs(now - before).max() <= limit * (1 + 1e-9)
        before = now
    simulation.step(10000)  # it comes back to its posture
    assert not simulation.reason
    assert np.abs(simulation.data.qvel).max() < 1e-6


def test_a_delta_counts_once_a_call_however_long() -> None:
    model = mujoco.MjModel.from_xml_string(ARM.format(actuators=MOTORS, ground=0))
    robot = hurcules.Robot(model)
    robot.set_configuration([0.0, 1.2])
    hand = hurcules.PositionTask("hand", robot, "tip")
    controller = hurcules.WholeBodyController(robot, [hand], {"hand": hurcules.Delta(hand, 0.1)})
    simulation = hurcules.Simulation(model=model, controller=controller)
    start = hand.target.copy()
    simulation.step(2500, {"hand": [0.04, 0.0, 0.0]})
    assert hand.target - start == pytest.approx([0.04, 0.0, 0.0], abs=1e-3)


def test_height_fields_are_left_out_with_a_word() -> None:
    model = mujoco.MjModel.from_xml_string(ARM.format(actuators=MOTORS, ground=1))
    robot = hurcules.Robot(model)
    with pytest.warns(UserWarning, match="leaves out height fields, .*: ground"):
        task = hurcules.obstacles(robot)
    assert task.pairs(robot) == []
    with pytest.raises(hurcules.Error, match="a height field has no distance"):
        hurcules.DistanceTask("apart", robot, [("hand", "ground")])


def test_a_urdf_by_its_path_keeps_speeds_and_fixed_links(tmp_path: Path) -> None:
    link = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
    path = tmp_path / "arm.urdf"
    path.write_text(
        f'<robot name="arm"><link name="base"/><link name="arm">{link}</inertial></link>'
        '<link name="tool"/><joint name="turn" type="revolute"><parent link="base"/>'
        '<child link="arm"/><axis xyz="0 0 1"/>'
        '<limit lower="-1" upper="1" velocity="1.5" effort="50"/></joint>'
        '<joint name="flange" type="fixed"><parent link="arm"/><child link="tool"/>'
        '<origin xyz="0.5 0 0"/></joint></robot>'
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        robot = hurcules.Robot(path)
    (turn,) = robot.coordinates
    assert (turn.max_velocity, turn.max_effort) == (1.5, 50.0)
    assert robot.position("tool") == pytest.approx([0.5, 0.0, 0.0])


def test_axes_are_directions_of_any_length() -> None:
    model = mujoco.MjModel.from_xml_string(ARM.format(actuators=MOTORS, ground=0))
    robot = hurcules.Robot(model)
    robot.set_configuration([0.5, 0.5])
    along = hurcules.PositionTask("along", robot, "tip", axes=[[3.0, 4.0, 0.0]])
    assert along.value == pytest.approx(robot.position("tip") @ [0.6, 0.8, 0.0])
    with pytest.raises(hurcules.Error, match="want directions that differ"):
        hurcules.PositionTask("twice", robot, "tip", axes=[[0, 0, 1], [0, 0, 2]])


@pytest.mark.parametrize("control", ["velocity", "acceleration", "torque"])
def test_gravity_that_actuators_compensate_is_counted_once(control: str) -> None:
    text = ARM.format(actuators=MOTORS, ground=0)
    text = text.replace('axis="0 0 1"', 'axis="0 1 0" actuatorgravcomp="true"')
    model = mujoco.MjModel.from_xml_string(text.replace("<body ", '<body gravcomp="1" '))
    robot = hurcules.Robot(model)
    robot.set_configuration([-0.4, 1.2])
    assert robot.inverse_dynamics([0.0, 0.0]) == pytest.approx([0.0, 0.0], abs=1e-12)
    hand = hurcules.PositionTask("hand", robot, "tip", axes=[[1, 0, 0], [0, 0, 1]])
    controller = hurcules.WholeBodyController(robot, [hand], control=control)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        simulation = hurcules.Simulation(model=model, controller=controller)
    place = simulation.data.site("tip").xpos.copy()
    simulation.step(3000)
    assert simulation.data.site("tip").xpos == pytest.approx(place, abs=1e-5)


def test_a_centre_of_mass_is_that_of_one_robot() -> None:
    text = ARM.format(actuators=MOTORS + '<motor joint="other"/>', ground=0)
    other = '<body pos="2 0 1"><joint name="other"/><geom fromto="0 0 0 1 0 0"/></body>'
    model = mujoco.MjModel.from_xml_string(text.replace("</worldbody>", other + "</worldbody>"))
    both, one = hurcules.Robot(model), hurcules.Robot(model, joints=["a", "b"])
    square = [[-1, -1], [1, -1], [1, 1], [-1, 1]]
    hurcules.CenterOfMassTask("com", one)
    for make in (
        lambda: hurcules.CenterOfMassTask("com", both),
        lambda: hurcules.BalanceTask("com", both, square),
        lambda: hurcules.ZeroMomentTask("com", both, square),
    ):
        with pytest.raises(hurcules.Error, match="'a' and 'other' move bodies of two trees"):
            make()


def test_a_rotation_is_a_matrix_or_a_quaternion() -> None:
    model = mujoco.MjModel.from_xml_string(ARM.format(actuators=MOTORS, ground=0))
    robot = hurcules.Robot(model)
    turn, quaternion = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.0]]), [1.0, 0, 0, 1.0]
    pose = hurcules.PoseTask("pose", robot, "tip")
    hand = hurcules.OrientationTask("hand", robot, "tip")
    pose.set_target([0.1, 0.2, 0.3], quaternion)
    hand.set_target(quaternion)
    assert pose.target_orientation == pytest.approx(turn)
    assert hand.target == pytest.approx(turn)
    for wrong in (np.eye(4), np.zeros(4), np.zeros(3), [1, 0, 0], "up", None):
        with pytest.raises(hurcules.Error, match=r"^target of task 'hand' wants"):
            hand.set_target(wrong)
    said = r"orientation of task 'pose' wants \(3, 3\), or .* \(4, 4\) came"
    with pytest.raises(hurcules.Error, match=said):
        pose.set_target([0.1, 0.2, 0.3], np.eye(4))


def test_what_runs_is_not_copied_by_copy() -> None:
    simulation, _ = loop()
    controller = simulation.controller
    for copying in (copy.copy, copy.deepcopy, pickle.dumps):
        for one in (simulation, controller, controller.tasks[0], controller.plan):
            with pytest.raises(hurcules.Error, match="neither copied nor pickled"):
                copying(one)


def test_an_answer_is_not_copied_and_says_what_to_take() -> None:
    solver = hurcules.rhqp.Solver(1)
    solution = solver.solve([hurcules.rhqp.Bounds([0.0], [1.0])])
    for copying in (copy.copy, copy.deepcopy, pickle.dumps):
        with pytest.raises(hurcules.Error, match=r"take what you need of it, solution\.x say"):
            copying(solution)
        with pytest.raises(hurcules.Error, match=r"a Solver is neither .*: make another one"):
            copying(solver)


def test_joints_that_are_held_are_told_unless_they_were_chosen_or_have_springs() -> None:
    text = ARM.format(actuators=MOTORS.split("/>")[0] + "/>", ground=0)
    model = mujoco.MjModel.from_xml_string(text)
    with pytest.warns(UserWarning, match=r"of their own drives are held: b; .* silences this"):
        hurcules.Robot(model)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        hurcules.Robot(model, joints=["a"])
        springs = text.replace('name="b"/>', 'name="b" stiffness="50"/>')
        assert "b" in hurcules.Robot(mujoco.MjModel.from_xml_string(springs)).left_out


def test_tendons_that_drive_and_their_limits_are_told() -> None:
    tendon = '<tendon><fixed name="t" range="-1 1"><joint joint="b" coef="1"/></fixed></tendon>'
    text = ARM.format(actuators=MOTORS.split("/>")[0] + "/>", ground=0)
    text = text.replace('name="b"/>', 'name="b" stiffness="50"/>')
    text = text.replace("<actuator>", tendon + "<actuator>")
    pulled = text.replace("</actuator>", '<motor tendon="t"/></actuator>')
    with pytest.warns(UserWarning, match="of their own drives are held: b;"):
        hurcules.Robot(mujoco.MjModel.from_xml_string(pulled))
    model = mujoco.MjModel.from_xml_string(text)
    assert "Tendons" not in hurcules.Robot(model).left_out  # b is held: it does not move
    both = hurcules.Robot(model, joints=["a", "b"])
    assert both.left_out == "Tendons whose limits of length are not kept: t"
