"""Several robots in one model: what docs/loop.md says of them.

Strategy: the same arm of three joints twice, by prefixes with a slash. Each controller moves its
own hand alone; a load that is handed over by welds is borne by the hand that has it when the robot
is made. Not tested: robots of other packages, whose figures docs/loop.md gives.
"""

from typing import Any

import mujoco
import numpy as np
import pytest

import hurcules

ARM = """<mujoco>
  <default><joint axis="0 1 0" armature="0.05" range="-150 150"/>
    <geom type="capsule" size="0.04" mass="1.5" contype="0" conaffinity="0"/>
    <motor forcerange="-200 200"/></default>
  <worldbody><body name="base"><joint name="turn" axis="0 0 1"/><geom fromto="0 0 0 0 0 .3"/>
    <body name="upper" pos="0 0 .3"><joint name="shoulder"/><geom fromto="0 0 0 .4 0 0"/>
      <body name="fore" pos=".4 0 0"><joint name="elbow"/><geom fromto="0 0 0 .4 0 0"/>
        <body name="hand" pos=".4 0 0"/></body></body></body></worldbody>
  <custom><numeric name="velocity_limit_elbow" data="1.5"/></custom>
  <actuator><motor joint="turn" name="turn"/><motor joint="shoulder" name="shoulder"/>
    <motor joint="elbow" name="elbow"/></actuator>
  <keyframe><key name="bent" qpos="0 -0.6 1.4"/></keyframe></mujoco>"""
ARMS, BENT = ("left/", "right/"), [0.0, -0.6, 1.4]
MOVES = {"left/": np.array([0.05, 0.05, 0.1]), "right/": np.array([-0.05, 0.0, 0.05])}  # [m/s]


def scene(load: float = 0.0) -> mujoco.MjSpec:
    world = mujoco.MjSpec()
    world.option.timestep = 0.001
    for i, arm in enumerate(ARMS):
        frame = world.worldbody.add_frame(pos=[0.0, i, 0.0])
        world.attach(mujoco.MjSpec.from_string(ARM), prefix=arm, frame=frame)
    if load:
        body = world.worldbody.add_body(name="load")
        body.add_freejoint()
        body.add_geom(size=[0.03, 0, 0], mass=load, contype=0, conaffinity=0)
        for arm in ARMS:
            weld = world.add_equality(
                type=mujoco.mjtEq.mjEQ_WELD,
                objtype=mujoco.mjtObj.mjOBJ_BODY,
                name1=f"{arm}hand",
                name2="load",
                active=arm == "left/",
            )
            weld.data[:11] = [0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1]
    return world


def joints_of(*arms: str) -> list[str]:
    return [f"{arm}{joint}" for arm in arms for joint in ("turn", "shoulder", "elbow")]


def start(model: mujoco.MjModel) -> mujoco.MjData:
    """Both arms bent; a load in the left hand."""
    data = mujoco.MjData(model)
    for name, angle in zip(joints_of(*ARMS), [*BENT, *BENT], strict=True):
        data.joint(name).qpos[0] = angle
    mujoco.mj_forward(model, data)
    if model.nq > len(joints_of(*ARMS)):
        data.qpos[-7:] = [*data.body("left/hand").xpos, *data.body("left/hand").xquat]
    return data


def controller(model: mujoco.MjModel, qpos: Any, *arms: str, **options: Any) -> Any:
    robot = hurcules.Robot(model, joints_of(*arms))
    robot.set_qpos(qpos)
    hands = [hurcules.PositionTask(arm, robot, f"{arm}hand") for arm in arms]
    channels = {hand.name: hurcules.Twist(hand, 0.3) for hand in hands}
    levels = [hands, hurcules.PostureTask("posture", robot)]
    return hurcules.WholeBodyController(robot, levels, channels, **options)


def hands(data: mujoco.MjData) -> dict[str, Any]:
    return {arm: data.body(f"{arm}hand").xpos.copy() for arm in ARMS}


@pytest.mark.parametrize("control", ["velocity", "acceleration", "torque"])
def test_one_controller_leads_both(control: str) -> None:
    model = scene().compile()
    led = controller(model, start(model).qpos, *ARMS, control=control)
    simulation = hurcules.Simulation(model=model, controller=led, record=False)
    was = hands(simulation.data)
    simulation.step(1000, {"left/": MOVES["left/"]})
    simulation.step(1000)
    moved = {arm: place - was[arm] for arm, place in hands(simulation.data).items()}
    assert moved["left/"] == pytest.approx(MOVES["left/"], abs=1e-4)
    assert moved["right/"] == pytest.approx(np.zeros(3), abs=1e-5)


def test_what_was_made_for_the_other_arm_is_refused() -> None:
    """As many coordinates of the same model: it led nothing, and only diagnostics told."""
    model = scene().compile()
    left, right = (hurcules.Robot(model, joints_of(arm)) for arm in ARMS)
    hand = hurcules.PositionTask("hand", right, "right/hand")
    limits = hurcules.JointLimits("limits", right)
    posture = hurcules.PostureTask("posture", left)
    said = "made for another robot: other coordinates of the same model .* than left/turn, left/"
    for levels in ([hand, posture], [limits, posture]):
        with pytest.raises(hurcules.Error, match=said):
            hurcules.WholeBodyController(left, levels)
    again = hurcules.Robot(model, joints_of("right/"))
    hurcules.WholeBodyController(again, [limits, hand])


def test_a_limit_keeps_its_robot() -> None:
    robot = hurcules.Robot(scene().compile(), joints_of(*ARMS))
    speeds = hurcules.JointLimits("limits", robot).max_velocity
    assert speeds[[2, 5]] == pytest.approx(1.5)


@pytest.mark.parametrize("control", ["velocity", "acceleration", "torque"])
def test_of_two_controllers_each_writes_its_own_rows(control: str) -> None:
    model = scene().compile()
    data = start(model)
    own = {arm: controller(model, data.qpos, arm, control=control) for arm in ARMS}
    rows = {
        arm: [i for i in range(model.nu) if model.actuator(i).name.startswith(arm)] for arm in ARMS
    }
    was = hands(data)
    for tick in range(2000):
        for arm, one in own.items():
            command = {arm: MOVES[arm]} if tick < 1000 else None
            data.ctrl[rows[arm]] = one.tick(data.qpos, data.qvel, command)[rows[arm]]
        mujoco.mj_step(model, data)
    for arm, place in hands(data).items():
        assert place - was[arm] == pytest.approx(MOVES[arm], abs=1e-4)


def test_a_load_is_handed_over() -> None:
    # by a controller that goes on reckoning with it in the left hand they were 0.21 and 0.33 m off
    model = scene(load=2.0).compile()
    data = start(model)
    was = hands(data)
    model.eq_active0[:] = data.eq_active[:] = [0, 1]
    data.qpos[-7:] = [*data.body("right/hand").xpos, *data.body("right/hand").xquat]
    led = controller(model, data.qpos, *ARMS, control="torque")
    led.reset(data.qpos)
    for _ in range(2000):
        data.ctrl[:] = led.tick(data.qpos, data.qvel)
        mujoco.mj_step(model, data)
    for arm, place in hands(data).items():
        assert place == pytest.approx(was[arm], abs=1e-5)


def test_what_stands_beside_hurcules_is_left_out_with_a_word() -> None:
    spec = hurcules.models.make("manipulation", "flat")
    frame = spec.worldbody.add_frame(pos=[0.0, 2.0, 0.0])
    spec.attach(mujoco.MjSpec.from_string(ARM), prefix="arm/", frame=frame)
    left_out = hurcules.Robot(spec.compile()).left_out
    assert left_out.startswith("3 joints with actuators stand beside the robot")
    assert "arm/turn, arm/shoulder, arm/elbow; Robot(model, joints=[...])" in left_out
    assert hurcules.Robot(hurcules.models.load("manipulation")).left_out == ""


def test_each_of_two_hurcules_drives_by_its_own_belts() -> None:
    """The first one drove, whose belts are named as in the default."""
    spec = hurcules.models.make("manipulation", "flat")
    other = hurcules.models.make("manipulation", "flat")
    for thing in [*other.worldbody.geoms, *other.worldbody.lights, *other.worldbody.cameras]:
        other.delete(thing)
    spec.attach(other, prefix="b/", frame=spec.worldbody.add_frame(pos=[0.0, 2.0, 0.0]))
    model = spec.compile()
    second = hurcules.Robot(model, joints=["b/" + name for name in ("LSP", "LEB")])
    controller = hurcules.WholeBodyController(
        second,
        [hurcules.PostureTask("posture", second)],
        {"drive": hurcules.Drive(speed=0.5, yaw_rate=0.5)},
        drive=hurcules.DriveOptions(),
        base="sensed",
    )
    simulation = hurcules.Simulation(model=model, controller=controller, record=False)
    simulation.step(1000, {"drive": [0.5, 0.0]})
    turned = {
        prefix: float(simulation.data.joint(f"{prefix}L_lower_belt").qvel[0])
        for prefix in ("", "b/")
    }
    assert turned["b/"] > 1.0
    assert abs(turned[""]) < 0.1
    with pytest.raises(hurcules.Error, match="drive 'left' does not exist; there are: b/LKN"):
        hurcules.WholeBodyController(
            second,
            [hurcules.PostureTask("posture", second)],
            {"drive": hurcules.Drive(speed=0.5, yaw_rate=0.5)},
            drive=hurcules.DriveOptions(),
            belts=("left", "right"),
            base="sensed",
        )
