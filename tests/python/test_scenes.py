"""Scenes made from parameters: they load, carry both robots, repeat, and refuse what is wrong.

Strategy: what must hold for every kind is asked of every kind, in a loop over those that exist;
what one kind promises stands in test_scene_shapes.py, _rough, _drive and test_things.py. Not
tested: the looks, and how hard a setting a robot masters.
"""

import math
import sys

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import models, scenes
from standing import stand

DRAWN = {"step_field", "rough_road", "gravel", "sand", "debris"}  # kinds with random numbers
# [robot#static-stability] a standing robot tips over backwards on 22 degrees: on slopes it drives
SLOPES = {"slope", "slope30", "slope30_down", "slope30_across"}
EVERY = [*scenes.names(), *scenes.PRESETS]


def bits(model: mujoco.MjModel) -> bytes:
    size = mujoco.mj_sizeModel(model)
    buffer = np.empty(size, np.uint8)
    mujoco.mj_saveModel(model, None, buffer)
    return buffer.tobytes()


def extremes(kind: str) -> list[dict[str, object]]:
    """Each parameter at both ends of its range, or at each of its values; the others at default."""
    found: list[dict[str, object]] = []
    for p in scenes.parameters(kind):
        found += [{p.name: value} for value in p.choices or (p.low, p.high)]
    return found


@pytest.mark.parametrize("robot", models.names())
@pytest.mark.parametrize("kind", EVERY)
def test_a_robot_stands_half_a_second(kind: str, robot: str) -> None:
    model = scenes.load(kind, robot)
    for key in ["home"] + ["ready"] * (kind not in SLOPES):
        stay = stand(model, key)
        assert stay.finite and stay.warnings == 0
        assert stay.moved < 2e-3, key
        assert stay.deepest < 1.5e-3, key


@pytest.mark.parametrize("kind", EVERY)
def test_the_same_seed_gives_the_same_bits_and_another_only_where_things_are_drawn(
    kind: str,
) -> None:
    first, again, other = (bits(scenes.load(kind, seed=seed)) for seed in (3, 3, 4))
    assert first == again
    assert (first != other) is (scenes.PRESETS.get(kind, (kind,))[0] in DRAWN)


@pytest.mark.parametrize("kind", scenes.names())
def test_every_parameter_works_at_both_ends_of_its_range(kind: str) -> None:
    for values in extremes(kind):
        try:
            model = scenes.make(kind, **values).compile()
        except hurcules.Error as error:  # two parameters that do not fit together say so
            assert kind in str(error) and "wants" in str(error)
            continue
        data = mujoco.MjData(model)
        mujoco.mj_step(model, data, 3)
        assert np.isfinite(data.qpos).all() and not any(w.number for w in data.warning), values


@pytest.mark.parametrize("kind", scenes.names())
def test_a_parameter_beyond_its_range_is_refused_with_what_was_wanted(kind: str) -> None:
    for p in scenes.parameters(kind):
        wrong = (
            ["nonsense", None] if p.choices else [p.low - 1, p.high * 2 + 1, math.nan, "1", True]
        )
        for value in wrong:
            with pytest.raises(hurcules.Error, match=f"{kind}: {p.name} wants .*, got "):
                scenes.scene(kind, **{p.name: value})


@pytest.mark.parametrize("kind", scenes.names())
def test_every_parameter_has_a_meaning_and_a_default_that_it_takes(kind: str) -> None:
    for p in scenes.parameters(kind):
        assert p.meaning and p.wanted
        scenes.scene(kind, **{p.name: p.default})


def test_wrong_names_are_answered_with_those_that_exist() -> None:
    with pytest.raises(hurcules.Error, match=r"scene 'nowhere' does not exist; .*slope.*slope30"):
        scenes.make("nowhere")
    with pytest.raises(hurcules.Error, match=r"slope: no parameter 'angel'; .*friction, angle"):
        scenes.make("slope", angel=0.1)
    with pytest.raises(hurcules.Error, match=r"'nobody' does not exist; .*rescue"):
        scenes.make("flat", robot="nobody")
    with pytest.raises(hurcules.Error, match=r"robot 'stretch' does not exist; .*rescue"):
        scenes.load("slope", "stretch")  # a scene, not a robot


@pytest.mark.parametrize("seed", [-1, 1.5, "0", True, None])
def test_a_bad_seed_is_refused(seed: object) -> None:
    with pytest.raises(hurcules.Error, match="flat: seed wants a whole number >= 0"):
        scenes.make("flat", seed=seed)


def test_friction_zero_is_refused() -> None:
    with pytest.raises(hurcules.Error, match=r"flat: friction wants a number from 0\.05 to 1\.5"):
        scenes.make("flat", friction=0.0)


def test_a_robot_inside_something_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    hurdle = sys.modules["hurcules.scenes.hurdle"].Hurdle
    monkeypatch.setattr(hurdle, "__post_init__", lambda self: None)  # no range check
    with pytest.raises(hurcules.Error, match=r"hurdle: .*hurdle_.* overlap by .* mm at the start"):
        scenes.load("hurdle", distance=-0.5)


@pytest.mark.parametrize("kind", scenes.names())
def test_all_ground_has_the_friction_that_was_asked_for(kind: str) -> None:
    model = scenes.make(kind, friction=0.37).compile()
    things = {"door": "door_", "valve": "valve_"}.get(kind, "\0")
    ground = [
        g for g in range(model.ngeom)
        if model.geom_contype[g] == 2 and not model.geom(g).name.startswith(things)
    ]  # fmt: skip
    names = [model.geom(g).name for g in ground]
    assert ground and not any(name == "" for name in names)
    assert model.geom_friction[ground, 0] == pytest.approx(0.37)


@pytest.mark.parametrize("kind", scenes.names())
def test_a_scene_is_mjcf_text_that_loads_again(kind: str) -> None:
    spec = scenes.make(kind, seed=1)
    model = spec.compile()
    again = mujoco.MjModel.from_xml_string(spec.to_xml())
    assert (again.ngeom, again.nq, again.nhfielddata) == (model.ngeom, model.nq, model.nhfielddata)
    assert again.geom_pos == pytest.approx(model.geom_pos, abs=1e-4)


@pytest.mark.parametrize("kind", EVERY)
def test_models_load_knows_the_scene_too(kind: str) -> None:
    assert kind in models.scenes()
    model = models.load("manipulation", scene=kind)
    assert model.body("upper_legs").subtreemass[0] == pytest.approx(680.0, abs=0.05)


def test_keyframes_keep_the_robot_and_leave_the_rest_where_it_begins() -> None:
    alone, scene = models.load("rescue"), scenes.load("casualty", mass=90)
    robot = alone.nq
    for i in range(alone.nkey):
        assert scene.key(i).name == alone.key(i).name
        assert list(scene.key_qpos[i][:robot]) == list(alone.key_qpos[i])
        assert list(scene.key_qpos[i][robot:]) == list(scene.qpos0[robot:])
