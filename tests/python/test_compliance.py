"""The elbow springs of the rescue robot: what they feel, and what they spare.

Strategy: the lower arms go down onto the ground in the physics, with springs and with the springs
locked; contact forces are MuJoCo's own. 2.5 N are to be felt (docs/design/robot.md#passive-joints;
claims H14, H15), the figures beside each limit were measured here.
"""

import numpy as np
import pytest

import hurcules
from hurcules import models
from hurcules_studies.thesis.measures.elbow_spring import contact_moment, lock, touch_down
from hurcules_studies.thesis.measures.rig import start


@pytest.fixture(scope="module")
def model():
    return models.load("rescue")


def test_the_spring_lowers_the_peak_of_the_contact_force():  # H14
    soft = touch_down(models.load("rescue"), 0.8).largest
    rigid = touch_down(lock(models.load("rescue")), 0.8).largest
    print(f"peak {soft:.0f} N with springs, {rigid:.0f} N rigid")
    assert soft < 0.5 * rigid


def test_the_force_from_the_deflection_is_that_of_the_contact(model):  # H15
    data = touch_down(model, 4.0, rest=1.5).data
    robot = hurcules.Robot(model)
    for side in "LR":
        sensor = hurcules.SpringForce(robot, f"{side}EBS", f"{side}_tcp")
        sensor.update(data.qpos, data.qvel)
        moment, force = contact_moment(model, data, side)
        print(f"{side}: contact {moment:.3f} N m, {force:.1f} N; felt {sensor.moment:.3f}")
        assert moment > 5.0 and not sensor.at_stop
        assert sensor.moment == pytest.approx(moment, rel=0.02)


def test_a_free_arm_at_rest_feels_less_than_the_smallest_force(model):  # K12: 2.5 N
    data, player = start(model, "rescue", "acquisition")
    player.wait(3.0)
    robot = hurcules.Robot(model)
    for side in "LR":
        sensor = hurcules.SpringForce(robot, f"{side}EBS", f"{side}_tcp")
        sensor.update(data.qpos, data.qvel)
        assert not sensor.at_stop and abs(sensor.force) < 0.25


def test_two_and_a_half_newtons_are_felt(model):
    data, player = start(model, "rescue", "acquisition")
    player.wait(2.0)
    sensor = hurcules.SpringForce(hurcules.Robot(model), "LEBS", "L_tcp")
    sensor.update(data.qpos, data.qvel)
    before, direction = sensor.deflection, sensor.direction.copy()
    point, body = data.site("L_tcp").xpos, model.body("L_larm").id
    data.xfrc_applied[body, :3] = push = 2.5 * direction
    data.xfrc_applied[body, 3:] = np.cross(point - data.xipos[body], push)
    player.wait(2.0)
    sensor.update(data.qpos, data.qvel)
    assert sensor.force == pytest.approx(2.5, abs=0.3)
    assert sensor.deflection - before == pytest.approx(2.5 * 0.7 / 500, rel=0.15)  # 3.5 mrad


def test_a_load_lies_on_the_stop_and_the_sensor_says_so(model):
    data, player = start(model, "rescue", "carry")
    data.xfrc_applied[model.body("L_larm").id, 2] = -60 * 9.81
    player.wait(1.0)
    sensor = hurcules.SpringForce(hurcules.Robot(model), "LEBS", "L_tcp")
    sensor.update(data.qpos, data.qvel)
    assert sensor.at_stop and abs(sensor.deflection) < 5e-3


def test_bad_names_are_answered_with_those_that_exist(model):
    robot = hurcules.Robot(model)
    with pytest.raises(hurcules.Error, match="'LEB' does not exist; there are: LEBS, REBS"):
        hurcules.SpringForce(robot, "LEB", "L_tcp")
    with pytest.raises(hurcules.Error, match="'nose' does not exist"):
        hurcules.SpringForce(robot, "LEBS", "nose")
    with pytest.raises(hurcules.Error, match="behind the spring 'LEBS'"):
        hurcules.SpringForce(robot, "LEBS", "R_tcp")
    with pytest.raises(hurcules.Error, match=rf"wants qpos \({model.nq},\)"):
        hurcules.SpringForce(robot, "LEBS", "L_tcp").update([0.0], [0.0])
