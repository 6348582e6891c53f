"""The ground carries a robot that drives: straight ahead, joints braked, no steering.

Strategy: a proportional law keeps the driven belts at a speed, the rest is physics. What is passed
and what is not follows from geometry and friction, with room on both sides; the largest settings
are for the test methods to find. Numbers of the robot: docs/design/robot.md.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import mujoco
import pytest

import hurcules
from hurcules import scenes
from standing import brake

RADIUS = 0.14  # [m] of the belts
GAIN = 800.0  # [N m s/rad]
PEAK = 600.0  # [N m]


@dataclass(frozen=True)
class Ride:
    """Where a robot came to, and how."""

    x: float  # [m]
    z: float  # [m]
    tilt: float  # [rad] largest
    deepest: float  # [m] largest overlap
    warnings: int


def ride(
    kind: str,
    seconds: float,
    speed: float = 0.6,
    change: Callable[[mujoco.MjSpec], None] = lambda spec: None,
    **values: object,
) -> Ride:
    spec = scenes.make(kind, robot="rescue", **values)
    change(spec)
    model = spec.compile()
    loss = model.dof_frictionloss.copy()
    brake(model)
    belts = [j for j in range(model.njnt) if model.joint(j).name.endswith("_belt")]
    free = [model.jnt_dofadr[j] for j in belts]
    model.dof_frictionloss[free] = loss[free]
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("drive").id)
    tilt = deepest = 0.0
    drives = [
        (model.actuator(f"{s}_drive").id, model.joint(f"{s}_lower_belt").dofadr[0]) for s in "LR"
    ]
    for _ in range(round(seconds * 1000)):
        for drive, belt in drives:
            torque = GAIN * (speed / RADIUS - data.qvel[belt])
            data.ctrl[drive] = min(max(torque, -PEAK), PEAK)
        hurcules.step(model, data)
        tilt = max(tilt, math.acos(min(1.0, data.body("upper_legs").xmat[8])))
        deepest = max([deepest] + [-c.dist for c in data.contact[: data.ncon]])
    warnings = sum(int(w.number) for w in data.warning)
    return Ride(float(data.qpos[0]), float(data.qpos[2]), tilt, deepest, warnings)


def test_on_the_flat_the_robot_goes_as_far_as_its_belts():
    run = ride("flat", 5.0)
    assert run.x == pytest.approx(3.0, abs=0.05)
    assert run.z == pytest.approx(RADIUS, abs=1e-3) and run.warnings == 0


# a track of 1.13 m bridges what is well below half its length [robot#static-stability]
@pytest.mark.parametrize("kind, values", [("gap", {"width": 0.4}), ("trench", {"width": 0.4})])
def test_a_gap_below_half_the_track_is_bridged_level(kind, values):
    run = ride(kind, 9.0, **values)
    assert run.x > 5.0 and run.tilt < math.radians(3) and run.deepest < 5e-3


def test_a_gap_as_long_as_the_track_is_not():
    run = ride("gap", 9.0, width=1.2, height=1.0)
    assert run.z < -0.3 or run.tilt > math.radians(20)


def test_the_incline_of_30_degrees_is_climbed_to_its_landing():  # [robot#what-the-thesis-gives]
    run = ride("incline", 14.0, landing=5.0)
    assert run.z == pytest.approx(2.0 + RADIUS, abs=0.01)
    assert run.tilt == pytest.approx(math.radians(30), abs=math.radians(3))


def test_with_too_little_friction_it_is_not():  # tan 30 = 0.577
    run = ride("incline", 12.0, friction=0.5)
    assert run.z < 1.0


@pytest.mark.parametrize("height", [0.06, 0.1])
def test_a_low_hurdle_is_climbed(height):
    run = ride("hurdle", 8.0, height=height)
    assert run.x > 3.8 and run.warnings == 0


@pytest.mark.parametrize("height", [0.005, 0.02, 0.05])
def test_no_sharp_edge_stops_the_robot_at_a_crawl(height):
    def add_step(spec):
        box, kind = mujoco.mjtGeom.mjGEOM_BOX, spec.find_default("terrain")
        size, pos = [5, 1.5, height / 2], [5.5, 0, height / 2]
        spec.worldbody.add_geom(kind, type=box, size=size, pos=pos)

    run = ride("flat", 12.0, speed=0.15, change=add_step)
    assert run.x > 1.6 and run.z == pytest.approx(RADIUS + height, abs=2e-3)


@pytest.mark.parametrize("kind", ["rough_road", "gravel", "sand"])
def test_rough_ground_is_crossed(kind):
    run = ride(kind, 12.0)
    assert run.x > 5.0 and run.tilt < math.radians(12)
    assert run.deepest < 0.02 and run.warnings == 0


def test_ramps_pitch_the_robot_by_their_angle():
    run = ride("ramps", 8.0, angle=math.radians(10))
    assert run.x > 4.5
    # it tips over each ridge and lands nose down, but never turns by both slopes together
    assert math.radians(9) < run.tilt < math.radians(20)
