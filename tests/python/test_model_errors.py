"""Models that lack something, or stand where they cannot: one clear line each.

Wrong MuJoCo: test_package.py; friction zero and other parameters of scenes: test_scenes.py.
"""

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import _core, models, scenes


def scene():
    return mujoco.MjSpec.from_file(str(models.path("stretch")))


def simulate(spec):
    model = spec.compile()
    return _core.Simulation(model, mujoco.MjData(model), "stretch")


RENAMED = {
    "a hand": (lambda spec: spec.site("L_tcp"), "frame 'L_tcp' does not exist; there are: .*R_tcp"),
    "the gaze": (lambda spec: spec.site("gaze"), "frame 'gaze' does not exist"),
    "the support": (lambda spec: spec.body("lower_leg_L"), "frame 'lower_leg_L' does not exist"),
    "the keyframe": (lambda spec: spec.key("stretch"), "keyframe 'stretch' .*: home, drive, ready"),
    "the hip": (
        lambda spec: next(t for t in spec.tuples if t.name == "coordinate_HIP"),
        "coordinate 'HIP' does not exist; there are: KN",
    ),
    "the person": (
        lambda spec: spec.site("casualty_near_side"), "frame 'casualty_near_side' does not exist"
    ),
}  # fmt: skip


@pytest.mark.parametrize("what", RENAMED)
def test_a_mission_names_what_its_model_lacks(what):
    find, says = RENAMED[what]
    spec = scene()
    find(spec).name = "gone"
    with pytest.raises(hurcules.Error, match=says):
        simulate(spec)


def test_a_motor_of_which_the_model_says_no_servo_gets_a_reckoned_one():
    spec = scene()
    spec.joint("bed_lift").name = "crane"
    for actuator in spec.actuators:
        if actuator.target == "bed_lift":
            actuator.target = "crane"
    with pytest.raises(hurcules.Error, match="'velocity_limit_bed_lift': joint 'bed_lift'"):
        hurcules.Robot(spec.compile())
    spec.numeric("velocity_limit_bed_lift").name = "velocity_limit_crane"
    model = spec.compile()
    data = mujoco.MjData(model)
    assert "crane" not in hurcules.servo_table(hurcules.Robot(model))
    _core.Simulation(model, data, "stretch").step(200)
    assert abs(data.joint("crane").qvel[0]) < 1e-3


def test_tracks_without_what_they_want_are_named():
    spec = scene()
    spec.option.cone = mujoco.mjtCone.mjCONE_PYRAMIDAL
    with pytest.raises(hurcules.Error, match="elliptic"):
        simulate(spec)


def test_a_person_in_the_way_of_the_robot_is_named():
    # the nearest that the scene allows is clear; the same person 1.3 m nearer is not
    assert scenes.load("casualty", distance=1.5).nq > 0
    from hurcules.scenes.overlap import require_clear

    spec = scenes.make("casualty", robot="rescue", distance=1.5)
    spec.body("casualty_pelvis").pos[0] -= 1.3
    with pytest.raises(hurcules.Error, match=r"casualty: '.*' and '.*' overlap by .* mm"):
        require_clear(spec.compile(), "casualty")


@pytest.mark.parametrize("robot", ["rescue", "manipulation"])
def test_no_keyframe_begins_in_an_overlap(robot):
    model = models.load(robot)
    data = mujoco.MjData(model)
    for key in range(model.nkey):
        mujoco.mj_resetDataKeyframe(model, data, key)
        mujoco.mj_fwdPosition(model, data)
        # the tracks sink in by 0.1 mm, about what the weight gives
        assert data.ncon and data.contact.dist.min() > -2e-4, model.key(key).name
        assert np.isfinite(data.qpos).all()


def test_parameters_are_those_of_a_scene_that_is_made():
    steep, plain = (
        models.load("rescue", "stairs", bed=False, visuals=False, **values)
        for values in ({"pitch": 0.7}, {})
    )
    assert steep.nq == plain.nq
    assert not np.array_equal(steep.geom_pos, plain.geom_pos)
    with pytest.raises(hurcules.Error, match="stairs: no parameter 'pich'; there are: "):
        models.load("rescue", "stairs", pich=0.6)
    with pytest.raises(hurcules.Error, match="pitch: wanted with a scene that has parameters"):
        models.load("rescue", "flat", pitch=0.6)
