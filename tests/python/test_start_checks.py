"""What would go wrong in the physics without a word is said before it starts.

Strategy: a chain of three light links as text. Joints that no coordinate moves stand still; joints
that nothing holds, and motors that are too weak for what hangs on them, are named; a robot with all
it wants gets no warning. Not tested: how far a robot with weak motors sinks.
"""

import re
import warnings

import mujoco
import numpy as np
import pytest

import hurcules

CHAIN = """<mujoco><option timestep="{step}"/><compiler angle="radian"/>
  <default><geom type="capsule" size="0.03"/><joint axis="0 1 0" range="-2 2"/></default>
  <worldbody><body><joint name="a"/><geom fromto="0 0 0 .4 0 0"/>
    <body pos=".4 0 0"><joint name="b"/><geom fromto="0 0 0 .3 0 0"/>
      <body pos=".3 0 0"><joint name="c" {last}/><geom fromto="0 0 0 .2 0 0"/></body>
    </body></body></worldbody>
  <actuator>{motors}</actuator></mujoco>"""
STRONG = '<motor joint="{}" ctrlrange="-90 90"/>'


def model(step: float = 0.002, motors: str = "abc", extra: str = "", last: str = ""):
    text = "".join(STRONG.format(name) for name in motors) + extra
    return mujoco.MjModel.from_xml_string(CHAIN.format(step=step, motors=text, last=last))


def simulation(chain: mujoco.MjModel, joints: list[str] | None) -> hurcules.Simulation:
    robot = hurcules.Robot(chain, joints=joints)
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(robot, [posture])
    return hurcules.Simulation(model=chain, controller=controller, record=False)


@pytest.mark.parametrize("step", [0.002, 0.001, 0.0005])
@pytest.mark.parametrize("joints", [["a"], ["c"], ["a", "c"], None])
def test_joints_that_no_coordinate_moves_stand_still(step: float, joints: list[str] | None) -> None:
    # with an inertia of 1 kg m^2 for a link of 0.02 they shook at 17 to 65 rad/s
    run = simulation(model(step), joints)
    run.step(round(2.0 / step))
    assert np.abs(run.data.qpos).max() < 1e-3
    assert np.abs(run.data.qvel).max() < 1e-3


def test_a_joint_that_nothing_holds_is_named() -> None:
    with pytest.warns(UserWarning, match="nothing holds b, and parts") as caught:
        simulation(model(motors="ac"), ["a", "c"])
    assert caught[0].filename == __file__


def test_a_start_outside_the_joint_limits_is_told() -> None:
    spec = mujoco.MjSpec.from_string(
        CHAIN.format(step=0.002, motors="".join(STRONG.format(name) for name in "abc"), last="")
    )
    spec.joint("b").range = [0.5, 2.0]  # nobody says where it starts: at 0
    with pytest.warns(UserWarning, match="starts outside its joint limits: b at 0, limits 0.5 to"):
        simulation(spec.compile(), None)


# its top 20 and 3 mm above the lower side of the last link; the last: before the straight arm,
# which turns no joint
TABLES = [([0.8, 0.0, -0.11], True), ([0.8, 0.0, -0.127], False), ([1.02, 0.0, 0.0], False)]


@pytest.mark.parametrize(("place", "told"), TABLES)
def test_bodies_that_lie_in_each_other_are_named(place: list[float], told: bool) -> None:
    spec = mujoco.MjSpec.from_string(
        CHAIN.format(step=0.002, motors="".join(STRONG.format(name) for name in "abc"), last="")
    )
    box = mujoco.mjtGeom.mjGEOM_BOX
    spec.worldbody.add_geom(type=box, size=[0.1, 1.0, 0.1], pos=place)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        simulation(spec.compile(), None)
    words = "lie in each other where the robot starts: "
    assert [words in str(one.message) for one in caught] == [True] * told


def test_motors_that_are_too_weak_are_named_with_what_is_wanted() -> None:
    weak = '<motor joint="a" ctrlrange="-1 1" gear="2"/>'
    with pytest.warns(UserWarning, match=r"weight on them where .*: a \(\d.* of 2 N m\)"):
        simulation(model(motors="bc", extra=weak), None)


@pytest.mark.parametrize(("period", "warns"), [(0.024, False), (0.04, True)])
def test_a_period_at_which_servos_swing_is_told(period: float, warns: bool) -> None:
    chain = model()
    robot = hurcules.Robot(chain)
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(robot, [posture], dt=period)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        hurcules.Simulation(model=chain, controller=controller, physics=False)
        assert not caught
        again = hurcules.WholeBodyController(robot, [posture], dt=period)
        hurcules.Simulation(model=chain, controller=again)
    assert [bool(re.search("40 ms is too long", str(one.message))) for one in caught] == [
        True
    ] * warns


@pytest.mark.parametrize(
    ("servo", "gives"),
    [  # the weight of the links wants 13 N m, upwards: negative
        ('<velocity joint="a" kv="4" ctrlrange="-2 2"/>', "8"),
        ('<velocity joint="a" kv="4" ctrlrange="-9 2"/>', None),
        ('<position joint="a" kp="10" ctrlrange="-1 1"/>', "10"),
        ('<position joint="a" kp="30" ctrlrange="-1 1"/>', None),
        ('<position joint="a" kp="30" ctrlrange="-1 1" forcerange="-9 20"/>', "9"),
        ('<position joint="a" kp="30" ctrlrange="-1 1" forcerange="-20 9"/>', None),
        ('<position joint="a" kp="30"/>', None),
        ('<motor joint="a" ctrlrange="-20 1"/>', None),
        ('<motor joint="a" ctrlrange="-1 20" gear="-1"/>', None),
        ('<motor joint="a" ctrlrange="-1 20"/>', "1"),
    ],
)
def test_servos_are_as_strong_as_their_range_of_controls_lets_them(
    servo: str, gives: str | None
) -> None:
    # an arm on velocity servos of 10 N m fell by 0.43 m without a word
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        simulation(model(motors="bc", extra=servo), None)
    told = [re.search(r": a \(13 of (.*) N m\)", str(one.message)) for one in caught]
    assert [one and one[1] for one in told] == [gives] * (gives is not None)


@pytest.mark.parametrize(
    ("motors", "last"), [("abc", ""), ("ab", 'stiffness="50"')], ids=["motors", "a spring"]
)
def test_a_robot_with_all_it_wants_is_let_go_without_a_word(motors: str, last: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        simulation(model(motors=motors, last=last), list(motors))


@pytest.mark.parametrize(
    ("option", "told"),
    [
        ('><flag actuation="disable"/></option>', "no actuator moves anything"),
        (' actuatorgroupdisable="3"/>', "switches actuators off: number 2$"),
    ],
)
def test_motors_that_the_model_switches_off_are_told(option: str, told: str) -> None:
    # a hand was 0.46 m off its plan without a word
    text = CHAIN.format(step=0.002, motors="".join(map(STRONG.format, "abc")), last="")
    text = text.replace('joint="c" ', 'joint="c" group="3" ').replace("/>", option, 1)
    with pytest.warns(UserWarning, match=told):
        simulation(mujoco.MjModel.from_xml_string(text), None)


def test_constraints_that_the_model_switches_off_are_told() -> None:
    couple = '</actuator><equality><joint joint1="c" joint2="b"/></equality><actuator>'
    chain = model(motors="ab", extra=couple)
    chain.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_EQUALITY
    with pytest.warns(UserWarning, match="the plan keeps the model's equality constraints"):
        simulation(chain, None)


@pytest.mark.parametrize(("frame", "warns"), [("late", True), ("early", False)])
def test_a_joint_before_the_hand_that_nothing_holds_is_named(frame: str, warns: bool) -> None:
    # the hand fell by 49 mm, its plan did not
    spec = mujoco.MjSpec.from_string(CHAIN.format(step=0.002, motors=STRONG.format("a"), last=""))
    spec.delete(spec.joint("b"))
    for name, parent in (("early", spec.bodies[1]), ("late", spec.bodies[-1])):
        parent.add_site(name=name, pos=[0.2, 0.0, 0.0])
    chain = spec.compile()
    robot = hurcules.Robot(chain, joints=["a"])
    hand = hurcules.PositionTask("hand", robot, frame)
    hand.set_target([0.1, 0.0, 0.1])
    controller = hurcules.WholeBodyController(robot, [hand])
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        hurcules.Simulation(model=chain, controller=controller)
    assert ["nothing holds c, and parts" in str(one.message) for one in caught] == [True] * warns
    np.testing.assert_array_equal(hand.target, [0.1, 0.0, 0.1])
    assert np.all(hand.error == hand.value - hand.target)


@pytest.mark.parametrize(
    ("damping", "integrator", "steps", "told"),
    [
        (1.0, "EULER", 2, None),
        (200.0, "EULER", 2, "most at c.* one physics step a period"),
        (200.0, "EULER", 1, None),
        (1.0, "IMPLICITFAST", 1, None),
        (200.0, "IMPLICITFAST", 1, "most at c.* a shorter one"),
    ],
)
def test_servo_actuators_that_swing_by_their_own_damping_are_told(
    damping: float, integrator: str, steps: int, told: str | None
) -> None:
    # of 120 random robots 16 diverged or swung so, without a word
    servo = f'<velocity joint="c" gear="2" kv="{damping / 4}"/>'
    chain = model(motors="ab", extra=servo)
    chain.opt.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{integrator}")
    robot = hurcules.Robot(chain)
    robot.set_configuration([0.0, 0.5, 0.5])
    controller = hurcules.WholeBodyController(
        robot, [hurcules.PostureTask("posture", robot)], dt=steps * chain.opt.timestep
    )
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        run = hurcules.Simulation(model=chain, controller=controller)
    assert [bool(told and re.search(told, str(one.message))) for one in caught] == [True] * bool(
        told
    )
    if not told:
        run.step(500)
        assert np.abs(run.data.qvel).max() < 1e-3


def test_lengths_in_millimetres_are_told() -> None:
    # an arm that was to move by 0.1 m moved by 17 mm, its motors at their limits
    text = CHAIN.format(step=0.002, motors="".join(map(STRONG.format, "abc")), last="")
    text = text.replace('pos=".4 0 0"', 'pos="400 0 0"').replace(
        "<option", '<option gravity="0 0 0"'
    )
    with pytest.warns(UserWarning, match="400 m apart, were millimetres"):
        simulation(mujoco.MjModel.from_xml_string(text), None)


def test_a_free_root_that_nothing_pulls_is_led_where_it_is() -> None:
    text = LEG.format(foot=0.3).replace("<worldbody>", '<option gravity="0 0 0"/><worldbody>')
    leg = mujoco.MjModel.from_xml_string(text)
    robot = hurcules.Robot(leg)
    controller = hurcules.WholeBodyController(robot, [hurcules.PostureTask("posture", robot)])
    with pytest.warns(UserWarning, match="gives way.* base='sensed'"):
        hurcules.Simulation(model=leg, controller=controller)


LEG = """<mujoco><option timestep="0.002"/><worldbody>
  <geom name="floor" type="plane" size="9 9 .1"/>
  <body name="trunk" pos="0 0 0.52"><freejoint/><geom type="box" size=".1 .1 .1" mass="10"/>
    <body name="leg" pos="0 0 -.1"><joint name="hip" axis="0 1 0"/>
      <geom type="capsule" size=".03" fromto="0 0 0 0 0 -.4" mass="1"/>
      <body name="foot" pos="0 0 -.4"><joint name="ankle" axis="0 1 0"/>
        <geom type="box" size=".1 .05 .02" mass="{foot}"/></body>
    </body></body></worldbody>
  <actuator><motor joint="hip" ctrlrange="-50 50"/><motor joint="ankle" ctrlrange="-50 50"/>
  </actuator></mujoco>"""


@pytest.mark.parametrize(("foot", "warns"), [(0.3, True), (30.0, False)])
def test_a_robot_that_stands_by_servos_on_a_light_foot_is_told_of_torques(
    foot: float, warns: bool
) -> None:
    leg = mujoco.MjModel.from_xml_string(LEG.format(foot=foot))
    robot = hurcules.Robot(leg)
    robot.stand_on("foot")
    controller = hurcules.WholeBodyController(robot, [hurcules.PostureTask("posture", robot)])
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        hurcules.Simulation(model=leg, controller=controller, record=False)
    words = "by servos on 'foot', 0.3 of its 11.3 kg, which nothing holds down.*control='torque'"
    assert [bool(re.search(words, str(one.message))) for one in caught] == [True] * warns


@pytest.mark.parametrize("wrong", ["spec", "data"])
def test_what_is_no_model_is_no_robot(wrong: str) -> None:
    # both ended the process
    chain = model()
    given = mujoco.MjSpec() if wrong == "spec" else mujoco.MjData(chain)
    with pytest.raises(hurcules.Error, match=f"a {type(given).__name__} came"):
        hurcules.Robot(given)


def beside(*models: str) -> mujoco.MjModel:
    """Robots in one world, 2 m apart."""
    world = mujoco.MjSpec()
    world.option.timestep = 0.002
    for i, text in enumerate(models):
        frame = world.worldbody.add_frame(pos=[0.0, 2.0 * i, 0.0])
        world.attach(mujoco.MjSpec.from_string(text), prefix=f"{i}/", frame=frame)
    return world.compile()


CHAIN_TEXT = CHAIN.format(step=0.002, motors="".join(map(STRONG.format, "abc")), last="")


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_a_free_root_beside_a_robot_that_stands_is_told(order: tuple[int, int]) -> None:
    # only that of the first coordinate was looked at
    texts = (CHAIN_TEXT, LEG.format(foot=30.0))
    with pytest.warns(UserWarning, match="root.* is free, and nothing says"):
        simulation(beside(*(texts[i] for i in order)), None)


def tied(active: str, name: str = "") -> mujoco.MjModel:
    weld = f'<weld body1="held" body2="hand" active="{active}" {name}/>'
    text = CHAIN_TEXT.replace(
        "</worldbody>",
        f'<body name="held" mocap="true"/></worldbody><equality>{weld}</equality>',
    )
    return mujoco.MjModel.from_xml_string(
        text.replace('<body pos=".3 0 0">', '<body name="hand" pos=".3 0 0">')
    )


def test_a_weld_that_the_plan_does_not_keep_is_told() -> None:
    # Fetch, whose gripper a mocap body holds, diverged; Sawyer ended 0.57 m off
    with pytest.warns(UserWarning, match="does not: that of held and hand. The robot pulls"):
        simulation(tied("true"), None)
    with pytest.warns(UserWarning, match="does not: grip. The robot pulls"):
        simulation(tied("true", 'name="grip"'), None)
    simulation(tied("false"), None)


def test_a_cloth_on_the_ground_is_no_part_of_the_robot() -> None:
    # its contacts name no geom, and the last one of the model was told
    cloth = """<geom type="plane" size="3 3 .1" pos="0 0 -2"/>
      <flexcomp name="cloth" type="grid" count="3 3 1" spacing=".1 .1 .1" radius=".01" mass=".1"
        dim="2" pos="0 0 -2"><contact selfcollide="none"/><edge equality="true"/></flexcomp>"""
    text = CHAIN_TEXT.replace("<worldbody>", f"<worldbody>{cloth}")
    simulation(mujoco.MjModel.from_xml_string(text), list("abc"))


def test_a_servo_that_is_told_of_no_joint_is_named() -> None:
    spec = mujoco.MjSpec.from_string(CHAIN.format(step=0.002, motors=STRONG.format("a"), last=""))
    spec.add_numeric(name="servo_a", data=[0.5, 20.0], size=2)
    spec.add_numeric(name="servo_shoulder", data=[0.5, 20.0], size=2)
    spec.add_numeric(name="servo_mode", data=[1.0], size=1)  # something else
    with pytest.warns(UserWarning) as caught:
        simulation(spec.compile(), ["a"])
    told = [str(one.message) for one in caught if "numeric" in str(one.message)]
    assert told == ["numeric 'servo_shoulder' holds for nothing: the model has no joint 'shoulder'"]


def beside_a_person(contype: int = 1) -> mujoco.MjModel:
    spec = mujoco.MjSpec.from_string(
        CHAIN.format(
            step=0.002, motors="".join(STRONG.format(name) for name in "abc"), last=""
        ).replace('<joint name="c" /><geom', '<joint name="c" /><site name="tip"/><geom')
    )
    table = spec.worldbody.add_geom(name="table", size=[0.1, 0.1, 0.1], pos=[0.6, 0.0, -0.5])
    table.type = mujoco.mjtGeom.mjGEOM_BOX
    person = spec.worldbody.add_body(name="person", mocap=True, pos=[2.0, 0.0, 0.0])
    forearm = person.add_body()
    forearm.add_geom(size=[0.1, 0.1, 0.1], contype=contype, conaffinity=contype)
    return spec.compile()


def warned(chain: mujoco.MjModel, levels: str, bodies: list[str]) -> list[str]:
    robot = hurcules.Robot(chain)
    made = {
        "c": hurcules.obstacles(robot, bodies=bodies),
        "s": hurcules.self_collision(robot),
        "h": hurcules.PositionTask("hand", robot, "tip"),
    }
    stack = [[made[one] for one in level] for level in levels.split()]
    controller = hurcules.WholeBodyController(robot, stack)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        hurcules.Simulation(model=chain, controller=controller, record=False)
    return [str(one.message) for one in caught]


def test_a_distance_below_a_hand_is_told() -> None:
    for levels in ("h c", "hc"):
        (told,) = warned(beside_a_person(), levels, ["person"])
        assert "'obstacles' stands below or beside 'hand' and gives way to it" in told
    assert warned(beside_a_person(), "c h", ["person"]) == []


def test_a_person_who_walks_and_counts_for_no_distance_is_told() -> None:
    (told,) = warned(beside_a_person(), "c h", [])
    assert told.startswith("no distance task counts 'person'") and "bodies=['person']" in told
    assert warned(beside_a_person(contype=0), "c h", []) == []  # a mark of a viewer
    assert warned(beside_a_person(), "h", []) == []  # nobody asked for distances
    assert warned(beside_a_person(), "s h", []) == []


def test_a_simulation_starts_where_the_robot_stood_when_its_controller_was_made() -> None:
    robot = hurcules.Robot(chain := model())
    robot.set_configuration(first := [0.1, 0.2, 0.3])
    controller = hurcules.WholeBodyController(robot, [hurcules.PostureTask("posture", robot)])
    robot.set_configuration(later := [0.4, 0.5, 0.6])  # too late
    run = hurcules.Simulation(model=chain, controller=controller)
    assert run.data.qpos == pytest.approx(first)
    run.reset(start=later)
    run.step(10)
    assert run.data.qpos == pytest.approx(later, abs=1e-3)
