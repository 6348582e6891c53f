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
LEGS = ("FL", "FR", "HL", "HR")
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
    assert model.nlight == 1  # and cameras look at where it stands
    assert model.stat.center[2] == pytest.approx(model.qpos0[2])
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


def test_a_scene_is_built_about_a_urdf(urdf: Path) -> None:
    plain = hurcules.load_urdf(urdf, floating=True)
    spec = hurcules.urdf_spec(urdf, floating=True)
    step = {"type": mujoco.mjtGeom.mjGEOM_BOX, "size": [0.3, 0.3, 0.05], "pos": [0.0, 0.0, 0.05]}
    spec.worldbody.add_geom(name="step", **step)
    spec.option.timestep = 0.001
    model = spec.compile()
    np.testing.assert_array_equal(model.qpos0, plain.qpos0)
    assert (model.nu, model.nbody, model.ngeom) == (plain.nu, plain.nbody, plain.ngeom + 1)
    qpos = model.qpos0.copy()
    qpos[2] += 0.1
    robot = hurcules.Robot(model, floating=True)
    robot.set_qpos(qpos)
    foot = hurcules.ContactTask("foot", robot, "foot")
    levels = [foot, hurcules.PostureTask("posture", robot)]
    controller = hurcules.WholeBodyController(robot, levels, control="torque")
    simulation = hurcules.Simulation(model=model, controller=controller, record=False)
    simulation.step(1000)
    assert simulation.data.qpos[2] == pytest.approx(0.12, abs=1e-3)
    assert controller.contact_force("foot")[2] == pytest.approx(4 * 9.81, abs=0.05)
    held = hurcules.urdf_spec(urdf).compile()
    assert (held.nq, held.nu) == (1, 1)


def test_on_floor_says_what_it_wants(urdf: Path) -> None:
    model = hurcules.load_urdf(urdf, floating=True)
    with pytest.raises(hurcules.Error, match="'ground' is none; there are: floor"):
        hurcules.on_floor(model, model.qpos0, "ground")
    with pytest.raises(hurcules.Error, match=r"of shape \(8,\), \(1,\) came"):
        hurcules.on_floor(model, model.qpos0[7:])
    with pytest.raises(hurcules.Error, match="name of a plane, 'floor' is none; there are: none"):
        hurcules.on_floor(hurcules.load_urdf(urdf), np.zeros(1))
    with pytest.warns(UserWarning, match="no shape of the robot can touch the floor"):
        model = hurcules.load_urdf(urdf, shapes=False, floating=True)
    with pytest.raises(hurcules.Error, match="no geom of the robot"):
        hurcules.on_floor(model, model.qpos0)


def test_a_robot_whose_meshes_are_not_read_is_given_feet(urdf: Path) -> None:
    # iCub and Romeo, whose meshes are COLLADA, could not float at all
    whole = hurcules.load_urdf(urdf, floating=True)
    told = "it falls through, and a ContactTask finds no sole; remedy: spec = urdf_spec"
    with pytest.warns(UserWarning, match=told) as caught:
        spec = hurcules.urdf_spec(urdf, shapes=False, floating=True)
    assert caught[0].filename == __file__
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert data.xpos[1:, 2].min() == pytest.approx(0.0)  # its lowest link
    sole = {"type": mujoco.mjtGeom.mjGEOM_BOX, "size": [0.1, 0.05, 0.02]}
    spec.body("foot").add_geom(**sole)
    model = spec.compile()
    robot = hurcules.Robot(model, floating=True)
    robot.set_qpos(hurcules.on_floor(model, model.qpos0))
    np.testing.assert_allclose(robot.qpos, whole.qpos0)
    foot = hurcules.ContactTask("foot", robot, "foot")
    levels = [foot, hurcules.PostureTask("posture", robot)]
    controller = hurcules.WholeBodyController(robot, levels, control="torque")
    simulation = hurcules.Simulation(model=model, controller=controller)
    simulation.step(500)
    assert controller.contact_force("foot")[2] == pytest.approx(4 * 9.81, abs=0.05)


@pytest.mark.parametrize("way", [[0.25, 0.0, 0.0], [0.0, -0.2, 0.0], [-0.2, 0.2, 0.0]])
@pytest.mark.parametrize("balanced", [True, False])
def test_a_centre_of_mass_that_is_led_beyond_the_feet_stops_over_them(
    way: list[float], balanced: bool
) -> None:
    robot = quadruped()
    shanks = [f"{leg}_shank" for leg in LEGS]
    corners = hurcules.support_polygon(robot, shanks)
    np.testing.assert_allclose(np.abs(corners), np.tile([0.2, 0.13], (4, 1)), atol=1e-9)
    feet = [hurcules.ContactTask(shank, robot, shank) for shank in shanks]
    balance = hurcules.BalanceTask("balance", robot, corners, margin=0.03)
    com = hurcules.CenterOfMassTask("com", robot)
    trunk = hurcules.OrientationTask("trunk", robot, "trunk")
    posture = hurcules.PostureTask("posture", robot)
    levels = [feet, *([balance] if balanced else []), [com, trunk], posture]
    channels = {"com": hurcules.Twist(com, 0.5)}
    controller = hurcules.WholeBodyController(robot, levels, channels, control="torque")
    simulation = hurcules.Simulation(model=QUADRUPED, controller=controller, record=False)
    data, second = simulation.data, round(1.0 / simulation.dt)
    height = data.body("trunk").xpos[2]
    simulation.step(second, {"com": way})
    simulation.step(2 * second)
    assert (data.body("trunk").xpos[2] > height - 0.05) == balanced
    if balanced:
        balance.update(controller.plan)
        assert balance.error.min() > 0.03 - 1e-3


def test_the_polygon_of_the_feet_is_convex_and_in_the_axes_of_a_frame(urdf: Path) -> None:
    model = hurcules.load_urdf(urdf, floating=True)
    robot = hurcules.Robot(model, floating=True)
    qpos = model.qpos0.copy()
    qpos[:2], qpos[3:7] = [3.0, 1.0], [np.cos(0.4), 0.0, 0.0, np.sin(0.4)]
    robot.set_qpos(qpos)
    corners = [[-0.1, -0.05], [0.1, -0.05], [0.1, 0.05], [-0.1, 0.05]]
    mine = hurcules.support_polygon(robot, ["foot"], "foot")
    np.testing.assert_allclose(sorted(mine.tolist()), sorted(corners), atol=1e-12)
    turn = np.array([[np.cos(0.8), -np.sin(0.8)], [np.sin(0.8), np.cos(0.8)]])
    there = hurcules.support_polygon(robot, "foot")
    np.testing.assert_allclose(
        sorted(there.tolist()), sorted(([3.0, 1.0] + corners @ turn.T).tolist()), atol=1e-12
    )
    edges = np.roll(there, -1, axis=0) - there
    after = np.roll(edges, -1, axis=0)
    assert np.all(edges[:, 0] * after[:, 1] - edges[:, 1] * after[:, 0] > 0.0)  # to the left
    quad = quadruped()
    three = hurcules.support_polygon(quad, ["FL_shank", "FR_shank", "HL_shank"])
    assert three.shape == (3, 2)
    for feet in (["FL_shank", "FR_shank"], []):
        with pytest.raises(hurcules.Error, match="soles that enclose an area, those of "):
            hurcules.support_polygon(quad, feet)


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
        ({"body": "hand"}, "a foot wants a body, 'hand' is on '"),
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


def test_velocities_lead_a_robot_that_floats_where_no_physics_holds_it() -> None:
    # whole-body kinematics were refused: "no velocity can be given to a free root"
    spec = mujoco.MjSpec.from_file(str(QUADRUPED))
    for leg in LEGS:
        spec.body(f"{leg}_shank").add_site(name=f"{leg}_foot", pos=[0.0, 0.0, -0.2])
    robot = hurcules.Robot(spec.compile(), floating=True)
    robot.set_keyframe("stand")
    feet = [hurcules.PositionTask(leg, robot, f"{leg}_foot") for leg in LEGS]
    com = hurcules.CenterOfMassTask("com", robot, axes=np.eye(3)[:2])
    trunk = hurcules.OrientationTask("trunk", robot, "trunk")
    hand = hurcules.PositionTask("hand", robot, "hand")
    com.set_target(robot.com[:2] + np.array([0.03, 0.02]))
    hand.set_target(robot.position("hand") + np.array([0.05, 0.0, 0.05]))
    levels = [feet, [com, trunk], hand]
    assert hurcules.inverse_kinematics(robot, levels).reached
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([*levels, hurcules.PostureTask("posture", robot)]))
    stood = robot.configuration[:3].copy()
    slid = 0.0
    for _ in range(3000):
        controller.step(robot)
        slid = max(slid, *(np.abs(foot.error).max() for foot in feet))
    for task in (com, trunk, hand):
        task.update(robot)
        assert np.abs(task.error).max() < 1e-6
    assert slid < 1e-3
    assert np.linalg.norm(robot.configuration[:3] - stood) > 0.02  # the root went along
    with pytest.raises(hurcules.Error, match="no reference can lead the free root"):
        hurcules.WholeBodyController(robot, levels)


def test_a_robot_that_floats_falls_by_its_height_over_the_ground_and_by_its_tilt() -> None:
    # the height over the support, which is its root, is 0 from the first tick on; without a frame
    # nobody looked at the tilt
    def limp(**limits: object) -> hurcules.Simulation:
        robot = quadruped()
        posture = hurcules.PostureTask("posture", robot)
        feet = [hurcules.ContactTask(leg, robot, f"{leg}_shank") for leg in LEGS]
        controller = hurcules.WholeBodyController(robot, [feet, posture], control="torque")
        fall = hurcules.FallOptions(**limits)
        return hurcules.Simulation(model=QUADRUPED, controller=controller, fall=fall)

    stands = limp(frame="trunk", min_height=0.25)
    stands.step(500)
    assert not stands.finished
    stands.data.qpos[2] = 0.2
    stands.step(2)
    assert stands.finished and "fell" in stands.reason
    tips = limp(max_tilt=0.5)
    tips.data.qpos[3:7] = [np.cos(0.3), np.sin(0.3), 0.0, 0.0]
    tips.step(2)
    assert tips.finished and "fell" in tips.reason
    with pytest.raises(hurcules.Error, match="min_height wants a frame"):
        limp(min_height=0.3)


def test_a_balance_task_follows_the_feet_that_stand() -> None:
    robot = quadruped()
    four = np.array([[0.2, 0.15], [-0.2, 0.15], [-0.2, -0.15], [0.2, -0.15]])
    balance = hurcules.BalanceTask("balance", robot, four, margin=0.02)
    com = hurcules.CenterOfMassTask("com", robot, axes=np.eye(3)[:2])
    posture = hurcules.PostureTask("posture", robot)
    feet = [hurcules.ContactTask(leg, robot, f"{leg}_shank") for leg in LEGS]
    levels = [feet, balance, com, posture]
    channels = {"com": hurcules.Twist(com, 0.3)}
    controller = hurcules.WholeBodyController(robot, levels, channels, control="torque")
    simulation = hurcules.Simulation(model=QUADRUPED, controller=controller)
    balance.set_polygon(four[:3])  # the diagonal is a side now, 3.75 x + 5 y = 0
    simulation.step(1000, {"com": [0.0, -0.05]})
    simulation.step(500)
    inward = np.array([-3.75, 5.0]) / np.hypot(3.75, 5.0)  # of the side from corner 3 to corner 1
    com_at = simulation.data.subtree_com[1][:2]
    assert (com_at - four[0]) @ inward == pytest.approx(0.02, abs=2e-3)
    state = simulation.state()
    balance.set_polygon(four)
    simulation.restore(state)  # the polygon is a part of it
    simulation.step(500)
    assert (simulation.data.subtree_com[1][:2] - four[0]) @ inward > 0.018
    balance.set_polygon(four)
    simulation.step(1000)
    assert (simulation.data.subtree_com[1][:2] - four[0]) @ inward < 0.0
    with pytest.raises(hurcules.Error, match="of up to 4 corners, 5 came"):
        balance.set_polygon([*four, [0.25, 0.0]])
    roomy = hurcules.BalanceTask("balance", robot, four, room=6)
    roomy.set_polygon([*four, [0.25, 0.0]])
    roomy.update(robot)
    assert roomy.rows == 6
    assert np.isfinite(roomy.error).all()
    with pytest.raises(hurcules.Error, match="convex"):
        balance.set_polygon(four[[0, 2, 1, 3]])
