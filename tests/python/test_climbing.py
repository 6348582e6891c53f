"""Climbing: the law of postures is the geometry it claims to be, and carries the robot over.

Strategy: tangents and angles reckoned anew, the centre of mass against the model's, the height that
statics allow against a balance of the model; then a hurdle and a flight in the physics, and a lean
that statics forbid. Not tested: the largest settings, which are results (docs/field_tests.md).
"""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import scenes
from hurcules_studies import field_tests
from hurcules_studies.field_tests import climbing
from hurcules_studies.field_tests.methods import Way

# nothing differs
SAME = field_tests.Variation(friction=(1.0, 1.0), payload=0.0, offset=0.0, yaw=0.0)


def stairs(degrees: float) -> climbing.OverStairs:
    return climbing.OverStairs(scenes.scene("stairs", pitch=math.radians(degrees)))


@pytest.mark.parametrize("rise", [0.3, 0.7, 1.1])
@pytest.mark.parametrize("height", [0.1, 0.3])
def test_the_raised_track_touches_the_edge(rise: float, height: float) -> None:
    knees = climbing.touch(2.0, height, rise)
    across = np.array([-math.sin(rise), math.cos(rise)])  # the upper side of the track
    to_edge = np.array([2.0 - knees, height - climbing.RADIUS])
    assert across @ to_edge == pytest.approx(-climbing.RADIUS)


@pytest.mark.parametrize("degrees", [30, 40])
def test_on_a_flight_the_upper_legs_stay_parallel_to_it(degrees: float) -> None:
    plan, pitch = stairs(degrees), math.radians(degrees)
    first = climbing.touch(2.0, 0.2, pitch)
    for x in np.arange(first - 0.1, first + 1.5, 0.05):
        lifted = max(0.0, x - first) * math.tan(pitch)
        sloped = math.asin(min(lifted / 0.85, math.sin(pitch)))  # the lower legs
        assert math.pi - plan(x).knee + sloped == pytest.approx(pitch, abs=1e-9)


@pytest.mark.parametrize("plan", [stairs(35), climbing.OverHurdle(scenes.scene("hurdle"))])
def test_a_posture_changes_step_by_step_while_the_obstacle_bears(plan: field_tests.Plan) -> None:
    begin = climbing.touch(2.0, 0.2, 0.45)
    postures = [plan(x) for x in np.arange(begin, 2.2, 0.01)]
    for name, most in (("knee", 0.03), ("hip", 0.03)):
        angles = np.array([getattr(one, name) for one in postures])
        assert np.abs(np.diff(angles)).max() < most
    assert all(one.speed <= 0.25 for one in postures)


@pytest.mark.parametrize("robot", ["rescue", "manipulation"])
@pytest.mark.parametrize("hip", [-0.4, 0.0, 0.4, 0.8])
def test_the_centre_of_mass_is_the_models(robot: str, hip: float) -> None:
    model = hurcules.models.load(robot)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("drive").id)
    data.qpos[:3] = 0.0
    for joint, angle in (climbing.ARMS | {"LKN": math.pi, "RKN": math.pi, "HIP": hip}).items():
        data.joint(joint).qpos[0] = angle
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    centre = data.subtree_com[model.body("upper_legs").id]
    assert climbing.CENTRE[0] + climbing.ARM * math.sin(hip) == pytest.approx(centre[0], abs=0.03)
    assert climbing.CENTRE[1] + climbing.ARM * math.cos(hip) == pytest.approx(centre[2], abs=0.06)


def test_the_higher_the_edge_the_less_the_trunk_leans_back_from_it() -> None:
    leans = [climbing.lean_over(height) for height in (0.1, 0.2, 0.3, 0.35, 0.4)]
    assert leans == sorted(leans, reverse=True)
    assert leans[0] == climbing.ACROSS and leans[-1] < 0.0
    assert climbing.highest(leans[3]) >= 0.35 and climbing.highest(leans[4]) >= 0.4


def test_who_raises_the_upper_legs_to_climb_has_not_fallen() -> None:
    upright = math.radians(70)
    raised = field_tests.Posture(math.pi - upright, climbing.STEADY - upright)

    def plan(_: object) -> field_tests.Plan:
        return lambda x: raised if x > 0.02 else climbing.STRETCHED

    tilts = []

    def watch(model: mujoco.MjModel, qpos: np.ndarray, time: float) -> None:
        tilts.append(2.0 * math.asin(min(1.0, math.hypot(qpos[4], qpos[5]))))

    method = field_tests.Method("", "flat", plan=plan, climbs=True, way=Way.There, distance=0.3)
    assert field_tests.repeat(method, None, "rescue", 0, watch=watch).fault == ""
    assert max(tilts) > math.radians(65)


@pytest.mark.slow
def test_it_crosses_a_hurdle_of_20_cm_turns_round_and_comes_back() -> None:
    result = field_tests.run("e2802", repetitions=1, settings=(0.2,), variation=SAME)
    assert result.passed and result.settings[0].metres_per_minute > 8.0


@pytest.mark.slow
def test_it_climbs_stairs_of_35_degrees_and_comes_down_in_reverse() -> None:
    result = field_tests.run("e2804", repetitions=1, settings=(math.radians(35),), variation=SAME)
    assert result.passed


@pytest.mark.slow
def test_a_lean_that_statics_forbid_tips_over(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(climbing, "lean_over", lambda height: climbing.ACROSS)
    assert climbing.highest(climbing.ACROSS) < 0.35
    result = field_tests.run("e2802", repetitions=1, settings=(0.4,), variation=SAME)
    assert not result.passed and result.settings[0].faults[0].fault == "tip-over"
