"""Servos of reckoned gains on an arm whose joints feel each other strongly.

Strategy: a ring and an arm turn about one axis, so that each alone turns a sixtieth of what it
turns while the other is held. The ring is swung to and fro and stopped. Negative control: the same
gains, joint by joint.
"""

import mujoco
import numpy as np
import pytest

import hurcules

ARM = """
<mujoco>
  <option timestep="0.004"/>
  <compiler angle="radian"/>
  <default><joint axis="0 0 1" range="-2.5 2.5" armature="0.01"/></default>
  <worldbody>
    <body name="ring"><joint name="turn"/>
      <geom type="cylinder" size="0.08 0.02" mass="2"/>
      <body name="arm"><joint name="swing"/>
        <geom type="capsule" fromto="0 0 0 0.6 0 0" size="0.05" mass="12"/>
        <body name="hand" pos="0.6 0 0"><joint name="wrist"/>
          <geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.03" mass="0.5"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>
    <motor joint="turn" ctrlrange="-200 200"/>
    <motor joint="swing" ctrlrange="-200 200"/>
    <motor joint="wrist" ctrlrange="-20 20"/>
  </actuator>
</mujoco>
"""


def swing(servo: dict[str, tuple[float, float]]) -> tuple[float, float]:
    """Largest joint error on the way [rad], and how far joints still move at the end [rad]."""
    model = mujoco.MjModel.from_xml_string(ARM)
    robot = hurcules.Robot(model)
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(
        robot, [posture], {"joints": hurcules.Twist(posture, 2.0)}, dt=0.004, servo=servo
    )
    simulation = hurcules.Simulation(model=model, controller=controller, record=False)
    read = hurcules.Quantities(simulation, ["q_des", "q"])
    errors, places = [], []
    for tick in range(750):
        way = np.sin(2 * np.pi * tick / 250) if tick < 500 else 0.0
        simulation.step(1, {"joints": [way, 0.0, 0.0]})
        commanded, measured = np.split(simulation.read(read), 2)
        errors.append(np.abs(commanded - measured).max())
        places.append(measured)
    return float(np.max(errors)), float(np.ptp(places[-125:], axis=0).max())


def test_one_joint_swings_and_comes_to_rest() -> None:
    error, rest = swing({})
    assert error < 0.01  # of +-0.64 rad
    assert rest < 5e-4


def test_joint_by_joint_the_same_gains_never_rest() -> None:
    # geometric means of the inertias with all others free and all others held
    alone = {"turn": (0.215, 30.0), "swing": (0.215, 30.0), "wrist": (0.0121, 30.0)}
    error, rest = swing(alone)
    assert error > 0.1
    assert rest > 0.1


def test_a_table_of_ones_own_may_leave_joints_out_and_names_none_that_is_not_there() -> None:
    swing({"turn": (0.2, 30.0), "swing": (0.2, 30.0)})
    with pytest.raises(hurcules.Error, match=r"'elbow' does not exist; there are: .*wrist"):
        swing({"elbow": (0.2, 30.0)})


def with_servos(**rows: str) -> str:
    """The arm, whose model says what servos reckon with."""
    custom = "".join(f'<numeric name="servo_{name}" data="{row}"/>' for name, row in rows.items())
    return ARM.replace("</worldbody>", f"</worldbody><custom>{custom}</custom>")


def led(text: str, **options: object) -> list[float]:
    """Where the joints are after a swing of 0.4 s."""
    model = mujoco.MjModel.from_xml_string(text)
    robot = hurcules.Robot(model)
    posture = hurcules.PostureTask("posture", robot)
    channels = {"joints": hurcules.Twist(posture, 2.0)}
    controller = hurcules.WholeBodyController(robot, [posture], channels, dt=0.004, **options)
    simulation = hurcules.Simulation(model=model, controller=controller, record=False)
    simulation.step(100, {"joints": [1.0, -0.5, 0.5]})
    return list(simulation.data.qpos)


def test_a_model_says_its_servos_and_a_controller_may_say_others() -> None:
    rows = {"turn": (0.2, 30.0), "swing": (0.3, 25.0), "wrist": (0.02, 20.0)}
    said = with_servos(**{name: f"{J} {omega}" for name, (J, omega) in rows.items()})
    robot = hurcules.Robot(mujoco.MjModel.from_xml_string(said))
    assert hurcules.servo_table(robot) == rows
    assert led(said) == led(ARM, servo=rows) != led(ARM)
    other = rows | {"wrist": (0.03, 15.0)}
    assert led(said, servo={"wrist": (0.03, 15.0)}) == led(ARM, servo=other) != led(said)
    for wrong in ("0.2", "0.2 30 1", "0 30", "0.2 -1"):
        with pytest.raises(hurcules.Error, match="'servo_turn' wants two numbers above 0"):
            led(with_servos(turn=wrong))
