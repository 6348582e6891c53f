"""The elbow springs of the rescue robot: what they feel, and what they spare.

Strategy: the lower arms go down onto the ground in the physics, with springs and with the springs
locked; contact forces are MuJoCo's own. [F] = hurcules-facts.md B3 (H14, H15) and A4 (2.5 N to be
felt), the figures beside each limit were measured here.
"""

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import models, postures
from lifting import start

DOWN = 0.12  # [rad] that the shoulders lower the scoops: their tips are 0.09 m above the ground


@pytest.fixture(scope="module")
def model():
    return models.load("rescue")


def contact_moment(model, data, side):
    """Moment about the elbow spring of all contacts of a lower arm [N m], and its largest force."""
    arm, joint = model.body(f"{side}_larm").id, data.joint(f"{side}EBS")
    moment, force, wrench = 0.0, 0.0, np.zeros(6)
    for i, contact in enumerate(data.contact[: data.ncon]):
        bodies = model.geom_bodyid[contact.geom]
        if arm not in bodies:
            continue
        mujoco.mj_contactForce(model, data, i, wrench)
        push = contact.frame.reshape(3, 3).T @ wrench[:3] * (1 if bodies[1] == arm else -1)
        moment += joint.xaxis @ np.cross(contact.pos - joint.xanchor, push)
        force += push[2]
    return moment, force


def lock(model):
    """The same robot with rigid elbows."""
    for side in "LR":
        dof = model.joint(f"{side}EBS").dofadr[0]
        model.dof_frictionloss[dof] = 1e5
        model.dof_solref[dof], model.dof_solimp[dof] = [0.004, 1], [0.9999, 0.9999, 0.001, 0.5, 2]
    return model


def touch_down(model, seconds):
    """Lowers the scoops onto the ground: the largest force on the way [N], data and player."""
    data, player = start(model, "rescue", "acquisition")
    player.play([postures.move("settle", 1.0, SP=0.876)])
    largest = 0.0
    down = postures.move("down", seconds, hold=0.0, SP=0.876 - DOWN)
    begin, speed = player.reference.copy(), np.zeros(len(player.joints))
    result, worst = postures.Result("down"), np.zeros((2, len(player.joints)))
    for i in range(round(1000 * seconds)):
        for j, joint in enumerate(player.joints):
            if joint in down.joints():
                player.reference[j], speed[j] = down.target(joint, begin[j], (i + 1) * 1e-3)
        player._tick(speed, worst, result)
        largest = max(largest, *(contact_moment(model, data, s)[1] for s in "LR"))
    return largest, data, player


def test_the_spring_lowers_the_peak_of_the_contact_force():  # H14
    soft = touch_down(models.load("rescue"), 0.8)[0]
    rigid = touch_down(lock(models.load("rescue")), 0.8)[0]
    print(f"peak {soft:.0f} N with springs, {rigid:.0f} N rigid")
    assert soft < 0.5 * rigid


def test_the_force_from_the_deflection_is_that_of_the_contact(model):  # H15
    _, data, player = touch_down(model, 4.0)
    player.wait(1.5)
    robot = hurcules.Robot(model)
    for side in "LR":
        sensor = hurcules.SpringForce(robot, f"{side}EBS", f"{side}_tcp")
        sensor.update(data.qpos, data.qvel)
        moment, force = contact_moment(model, data, side)
        print(f"{side}: contact {moment:.3f} N m, {force:.1f} N; felt {sensor.moment:.3f}")
        assert moment > 5.0 and not sensor.at_stop
        assert sensor.moment == pytest.approx(moment, rel=0.02)


def test_a_free_arm_at_rest_feels_less_than_the_smallest_force(model):  # [F B7] K12: 2.5 N
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
