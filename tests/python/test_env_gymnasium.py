"""The environments inside Gymnasium: its checker, registration, vectors, storage, pictures."""

import copy
import json
import os
import pickle
import subprocess
import sys
import warnings

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import hurcules
from environments import IDS, env, same
from hurcules_envs.base import HurculesEnv
from hurcules_envs.single import SingleEnv

__all__ = ["env"]


@pytest.mark.parametrize("name", IDS)
def test_gymnasiums_checker_has_nothing_to_say(name: str) -> None:
    env = gymnasium.make(name)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env.unwrapped)
    env.close()


@pytest.mark.parametrize("name", IDS)
def test_the_spec_and_the_environment_can_be_stored(name: str) -> None:
    env = gymnasium.make(name)
    assert env.spec is not None
    again = gymnasium.make(gymnasium.envs.registration.EnvSpec.from_json(env.spec.to_json()))
    pickled = pickle.loads(pickle.dumps(env.unwrapped))
    starts = [e.reset(seed=4)[0] for e in (env, again, pickled)]
    assert same(starts[0], starts[1])
    assert same(starts[0], starts[2])
    for e in (env, again, pickled, pickled):  # twice does no harm
        e.close()


@pytest.mark.parametrize("name", IDS)
def test_the_time_limit_truncates(name: str) -> None:
    env = gymnasium.make(name, max_episode_steps=3)
    env.reset(seed=0)
    ends = [env.step(np.zeros(11, np.float32))[2:4] for _ in range(3)]
    env.close()
    assert ends == [(False, False), (False, False), (False, True)]


@pytest.mark.parametrize("name", IDS)
def test_vectors_of_environments_step(name: str) -> None:
    envs = gymnasium.make_vec(name, num_envs=2, vectorization_mode="sync")
    observations, _ = envs.reset(seed=7)
    single = gymnasium.make(name)
    assert np.array_equal(observations[0], single.reset(seed=7)[0])
    assert envs.step(envs.action_space.sample())[0].shape == observations.shape
    single.close()
    envs.close()


def test_pictures_are_drawn(env: HurculesEnv) -> None:
    drawing = type(env)(render_mode="rgb_array")
    drawing.reset(seed=0)
    picture = drawing.render()
    drawing.close()
    assert picture is not None
    assert (picture.shape, picture.dtype) == ((368, 640, 3), np.uint8)
    assert picture.std() > 10


def test_a_vector_is_asked_for_pictures_as_gymnasiums_own() -> None:
    """The trainer of skrl calls render by name: the vector had no `call`."""
    for mode in ("sync", "vector_entry_point"):
        vector = gymnasium.make_vec(
            "Hurcules/Reach-v0", num_envs=2, fidelity="kinematic", vectorization_mode=mode
        )
        vector.reset(seed=0)
        with pytest.warns(UserWarning, match="render"):
            assert vector.call("render") == (None, None)
    with pytest.raises(hurcules.Error, match="call 'close' does not exist; there are: render"):
        vector.call("close")


@pytest.mark.parametrize("name", ["Reach-v0", "Drive-v0", "Stretch-v1"])
def test_infos_of_gymnasiums_vectors_are_of_the_types_of_a_native_one(name: str) -> None:
    """Flags were objects in Gymnasium's own: the mean of successes was True where one was."""
    own, native = (
        gymnasium.make_vec(
            f"Hurcules/{name}", num_envs=2, fidelity="kinematic", vectorization_mode=mode
        )
        for mode in ("sync", "vector_entry_point")
    )
    for infos in zip(
        (own.reset(seed=0)[1], own.step(own.action_space.sample())[4]),
        (native.reset(seed=0)[1], native.step(native.action_space.sample())[4]),
        strict=True,
    ):
        kinds = [{key: values.dtype for key, values in info.items()} for info in infos]
        assert kinds[0] == kinds[1]
        assert kinds[0]["is_success"].kind == "b"


def test_a_vector_is_asked_for_attributes_as_gymnasiums_own() -> None:
    own, native = (
        gymnasium.make_vec(
            "Hurcules/Reach-v0", num_envs=3, fidelity="fast", vectorization_mode=mode
        )
        for mode in ("sync", "vector_entry_point")
    )
    ranges = (0.4, 1.4)
    for vector in (own, native):
        vector.reset(seed=3)
        vector.set_attr("friction", [ranges] * 3)
        vector.set_attr("mass", 1.1)
        assert vector.get_attr("friction") == (ranges,) * 3
        assert vector.get_attr("mass") == ((1.1, 1.1),) * 3
        assert vector.get_attr("dt") == (0.05,) * 3
        assert vector.reset(seed=3)[1]["drawn_mass"].tolist() == [1.1] * 3
    for name in ("action_space", "observation_space", "task_description"):
        assert own.get_attr(name) == native.get_attr(name)
    for seen, alone in zip(native.call("observe", noise=False), own.call("observe"), strict=True):
        assert all(np.array_equal(seen[part], alone[part]) for part in alone)
    assert np.array_equal(native.call("get_state")[2], native.get_state()[2])
    assert native.call("friction") == own.call("friction")
    with pytest.raises(
        hurcules.Error, match=r"list of 3 .* got \(0.4, 1.4\); .* vector.friction ="
    ):
        native.set_attr("friction", ranges)
    with pytest.raises(hurcules.Error, match="3 that are the same"):
        native.set_attr("friction", [0.5, 0.5, 0.6])
    with pytest.raises(hurcules.Error, match="attribute 'frictoin' of the vector does not exist"):
        native.get_attr("frictoin")


@pytest.mark.parametrize("name", ["frictoin", "max_episode_steps", "rate"])
def test_an_attribute_that_nobody_reads_is_refused(name: str) -> None:
    """`env.unwrapped.max_episode_steps = 5` was taken in silence and changed nothing."""
    single = gymnasium.make("Hurcules/Reach-v0", fidelity="kinematic")
    vector = gymnasium.make_vec("Hurcules/Reach-v0", num_envs=2, fidelity="kinematic")
    for one in (single.unwrapped, copy.deepcopy(single).unwrapped, vector, copy.deepcopy(vector)):
        with pytest.raises(
            hurcules.Error, match=f"attribute '{name}' .* there are: friction, mass"
        ):
            setattr(one, name, 5)
    with pytest.raises(hurcules.Error, match=f"attribute '{name}'"):
        vector.set_attr(name, 5)


def test_a_class_of_ones_own_has_attributes_of_its_own() -> None:
    class Counted(SingleEnv):
        def __init__(self) -> None:
            super().__init__("hurcules_envs.reach:Reach", fidelity="kinematic")
            self.count = 0

    counted = Counted()
    counted.count += 1
    counted.label = "first"
    assert (counted.count, counted.label) == (1, "first")


def test_drawing_does_not_disturb_the_run(env: HurculesEnv) -> None:
    drawing = type(env)(render_mode="rgb_array")
    for e in (env, drawing):
        e.reset(seed=0)
    action = np.full(11, 0.5, np.float32)
    for _ in range(5):
        drawing.render()
        assert same(env.step(action), drawing.step(action))
    drawing.close()


def test_pictures_are_drawn_where_mujoco_was_imported_first() -> None:
    program = """
import mujoco, gymnasium
env = gymnasium.make("hurcules_envs:Hurcules/Stretch-v1", render_mode="rgb_array")
env.reset(seed=0)
print(env.render().shape)
env.close()
"""
    named = {name: value for name, value in os.environ.items() if name != "MUJOCO_GL"}
    words = [sys.executable, "-W", "error", "-c", program]
    done = subprocess.run(words, env=named, capture_output=True, text=True)
    assert done.stdout == "(368, 640, 3)\n", done.stderr


def test_without_a_renderer_the_remedy_is_named() -> None:
    program = f"""
import gymnasium, hurcules
env = gymnasium.make({IDS[0]!r}, render_mode="rgb_array")
env.reset(seed=0)
try:
    env.render()
except hurcules.Error as error:
    print(error)
"""
    done = subprocess.run(
        [sys.executable, "-c", program],
        env={**os.environ, "MUJOCO_GL": "disable"},
        capture_output=True,
        text=True,
    )
    assert done.stdout.startswith("no usable renderer (")
    assert "apt-get install" in done.stdout


def test_state_and_info_are_plain_numbers(env: HurculesEnv) -> None:
    _, info = env.reset(seed=0)
    plain = {
        key: value.tolist() if isinstance(value, np.ndarray) else value
        for key, value in info.items()
    }
    assert json.loads(json.dumps(plain)) == plain
    assert env.get_state().dtype == np.float64
