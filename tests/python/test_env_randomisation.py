"""What differs between episodes beside the task: factors, errors, delays, pushes.

Strategy: each effect on a cart of 1 kg whose motion is known; sameness of bits (nominal values,
threads, states) and refusals on registered environments. What ranges a policy bears is not tested.
"""

import copy
from pathlib import Path
from typing import Any

import gymnasium as gym
import mujoco
import numpy as np
import pytest

import hurcules
import hurcules_envs  # noqa: F401  registers
from hurcules_envs.randomisation import NAMES, PHYSICAL
from hurcules_envs.single import SingleEnv
from hurcules_envs.vector import NativeVectorEnv
from test_env_parameters import CART, NAME

RANGES: dict[str, Any] = {
    "friction": (0.5, 1.5), "mass": (0.8, 1.2), "motor_strength": (0.7, 1.0),
    "observation_noise": (0.0, 0.01), "action_delay": (0, 2), "push": (0.0, 300.0),
}  # fmt: skip
FAST = {"fidelity": "fast"}


def seen(observation: Any) -> Any:
    return observation["observation"] if isinstance(observation, dict) else observation


@pytest.fixture
def cart(tmp_path: Path) -> str:
    path = tmp_path / "cart.xml"
    path.write_text(CART)
    return str(path)


def place(env: SingleEnv) -> float:
    """Of the cart [m]."""
    return float(env.simulation.read(hurcules.Quantities(env.simulation, ["joint/rail"]))[0])


def driven(cart: str, steps: int = 10, **ranges: Any) -> list[float]:
    """Places of the cart after each step at 0.5 m/s from the first one on."""
    env = SingleEnv(NAME, path=cart, **ranges)
    env.reset(seed=0)
    places = []
    for _ in range(steps):
        env.step(np.array([1.0, 0.0], np.float32))
        places.append(place(env))
    return places


def test_nothing_differs_unless_it_is_asked_for(cart: str) -> None:
    _, info = SingleEnv(NAME, path=cart).reset(seed=0)
    nominal = {f"drawn_{name}": 0.0 for name in NAMES}
    nominal |= dict.fromkeys(("drawn_friction", "drawn_mass", "drawn_motor_strength"), 1.0)
    assert {key: value for key, value in info.items() if key.startswith("drawn_")} == nominal


@pytest.mark.parametrize("name", ["Reach-v0", "Drive-v0", "Carry-v0"])
def test_nominal_values_and_models_of_ones_own_change_no_bit(name: str) -> None:
    plain = gym.make(f"Hurcules/{name}", **FAST).unwrapped
    varied = gym.make(f"Hurcules/{name}", mass=(0.9, 1.1), **FAST).unwrapped
    plain.reset(seed=3)
    varied.reset(seed=1)  # has models of its own now
    varied.reset(seed=3, options={"mass": 1.0})
    generator = np.random.default_rng(0)
    for _ in range(15):
        action = generator.uniform(-1, 1, plain.action_space.shape).astype(np.float32)
        one, other = plain.step(action), varied.step(action)
        assert np.array_equal(seen(one[0]), seen(other[0]))
        assert one[1] == other[1]
        assert one[4] == other[4]


@pytest.mark.parametrize("name", ["Reach-v0", "Drive-v0", "Valve-v0"])
def test_bits_are_those_of_single_episodes_on_any_threads_and_after_a_state(name: str) -> None:
    ranges = RANGES | ({"payload": (0.0, 20.0)} if name == "Reach-v0" else {})
    name = f"Hurcules/{name}"
    vectors = [gym.make_vec(name, num_envs=2, threads=t, **FAST, **ranges) for t in (1, 2)]
    alone = gym.make(name, **FAST, **ranges).unwrapped
    other = gym.make(name, **FAST).unwrapped  # made without
    _, info = vectors[0].reset(seed=3)
    vectors[1].reset(seed=3)
    _, first = alone.reset(seed=3)
    other.reset(seed=9)
    drawn = [f"drawn_{word}" for word in ranges]
    assert all(first[key] == info[key][0] for key in drawn)
    assert all(info[key][0] != info[key][1] for key in drawn if key != "drawn_action_delay")
    for word, (low, high) in ranges.items():
        assert low <= first[f"drawn_{word}"] <= high
    generator = np.random.default_rng(0)
    for step in range(60):  # a push comes within 2 s
        actions = generator.uniform(-1, 1, vectors[0].action_space.shape).astype(np.float32)
        one, two = (vector.step(actions) for vector in vectors)
        single = alone.step(actions[0])
        assert np.array_equal(seen(one[0]), seen(two[0]))
        assert np.array_equal(seen(one[0])[0], seen(single[0]))
        if step == 30:
            other.set_state(alone.get_state())
            assert np.array_equal(seen(other.observe()), seen(single[0]))
        if step > 30:
            again = other.step(actions[0])
            assert np.array_equal(seen(again[0]), seen(single[0]))
            assert again[1:] == single[1:]


def test_episodes_start_where_they_would_without(cart: str) -> None:
    plain, varied = SingleEnv(NAME, path=cart), SingleEnv(NAME, path=cart, push=(0.0, 9.0))
    plain.reset(seed=5)
    varied.reset(seed=5)
    for _ in range(3):
        one, other = plain.reset()[1], varied.reset()[1]
        assert one["mass"] == other["mass"]
        assert one["drawn_push"] == 0.0 < other["drawn_push"]


def test_a_factor_is_written_into_the_model_of_the_episode_alone(cart: str) -> None:
    env = SingleEnv(NAME, path=cart, mass=1.5, friction=0.5, motor_strength=0.8)
    env.reset(seed=0)
    env.reset()  # once, not once more
    model, own = env._episodes._models[0], env.environment.simulation.model
    assert model.body("cart").mass[0] == 1.5 * own.body("cart").mass[0]
    assert model.body("load").mass[0] != 1.5 * own.body("load").mass[0]  # not the robot
    assert (model.geom_friction[:, 0] == 0.5 * own.geom_friction[:, 0]).all()
    assert (model.geom_friction[:, 1:] == own.geom_friction[:, 1:]).all()
    assert model.actuator_gainprm[0, 0] == 0.8
    assert (own.actuator_gainprm[0, 0], own.body("cart").mass[0]) == (1.0, 1.0)


def test_a_heavier_or_weaker_cart_lags_since_its_controller_does_not_know(cart: str) -> None:
    nominal = driven(cart, 3)
    heavy, weak = driven(cart, 3, mass=3.0), driven(cart, 3, motor_strength=1.0 / 3.0)
    assert heavy[0] < nominal[0] - 1e-4
    # a third of the force is as three times the mass
    assert weak == pytest.approx(heavy, abs=1e-4)
    assert driven(cart, 3, friction=0.5) == nominal  # nothing is touched


@pytest.mark.parametrize("robot", ["rescue", "manipulation"])
def test_a_payload_is_two_points_of_half_its_mass_in_the_hands(robot: str) -> None:
    env = gym.make("Hurcules/Reach-v0", robot=robot, payload=(4.0, 20.0), **FAST).unwrapped
    _, info = env.reset(seed=0)
    model, own = env.model, env.environment.simulation.model
    inertias, data = [], env.data
    for one in (own, model):
        other = mujoco.MjData(one)
        other.qpos[:] = data.qpos
        mujoco.mj_forward(one, other)
        inertias.append(np.zeros((one.nv, one.nv)))
        mujoco.mj_fullM(one, other, inertias[-1])
        # no part moves with the centre of its body
        assert np.allclose(other.geom_xpos, data.geom_xpos, atol=1e-12)
    wanted = inertias[0]
    for hand in env.environment.bearers:
        J = np.zeros((3, model.nv))
        mujoco.mj_jacSite(model, data, J, None, model.site(hand).id)
        wanted = wanted + info["drawn_payload"] / 2.0 * J.T @ J
    assert np.allclose(inertias[1], wanted, atol=1e-9 * np.abs(wanted).max())
    env.reset(seed=0, options={"payload": None})
    for name in ("body_mass", "body_inertia", "body_ipos", "body_sameframe", "geom_sameframe"):
        assert (getattr(env.model, name) == getattr(own, name)).all()


def test_a_payload_wants_hands_and_physics() -> None:
    with pytest.raises(hurcules.Error, match="payload: the hands of Drive bear none; Reach and"):
        gym.make("Hurcules/Drive-v0", payload=5.0, **FAST)
    with pytest.raises(hurcules.Error, match="payload: wants physics; fidelity"):
        gym.make("Hurcules/Reach-v0", payload=(0.0, 20.0), fidelity="kinematic")
    assert "drawn_payload" in gym.make("Hurcules/ReachJoint-v0", payload=5.0, **FAST).reset()[1]


def test_a_delayed_action_does_the_same_later(cart: str) -> None:
    nominal, late = driven(cart, 10), driven(cart, 10, action_delay=2)
    assert late[2:] == pytest.approx(nominal[:-2], abs=1e-9)
    assert abs(late[1]) < 1e-9


def test_errors_are_uniform_about_what_is_seen_and_none_is_twice_the_same(cart: str) -> None:
    plain = NativeVectorEnv(NAME, 50, path=cart)
    noisy = NativeVectorEnv(NAME, 50, path=cart, observation_noise=0.02)
    truth, _ = plain.reset(seed=1)
    found, _ = noisy.reset(seed=1)
    errors = [found - truth]
    hold = np.zeros((50, 2), np.float32)
    for _ in range(40):
        errors.append(noisy.step(hold)[0] - plain.step(hold)[0])
    swing, mass = np.array(errors)[..., 0], np.array(errors)[..., 1]
    assert np.abs(swing).max() <= 0.02 + 1e-6
    assert np.std(swing) == pytest.approx(0.02 / np.sqrt(3.0), rel=0.03)
    assert abs(np.mean(swing)) < 3 * 0.02 / np.sqrt(3.0 * swing.size)
    assert 1.9 < np.abs(mass).max() <= 2.0 + 1e-5  # [kg] count 100 times
    assert len(np.unique(np.round(swing, 7))) > 0.95 * swing.size


def test_a_push_falls_on_what_moves(tmp_path: Path) -> None:
    # it fell on the base, which is the heaviest and fixed
    base = '<body name="base"><geom pos="0 0 -1" size="0.1" mass="80"/><body name="cart">'
    text = CART.replace('<body name="cart">', base).replace("</body>", "</body></body>", 1)
    path = tmp_path / "fixed.xml"
    path.write_text(text)
    env = SingleEnv(NAME, path=str(path), push=20.0)
    model = env.environment.simulation.model
    assert model.body(env._episodes.randomisation.pushed).name == "cart"


def test_a_push_takes_a_fifth_of_a_second_every_two(cart: str) -> None:
    env = SingleEnv(NAME, path=cart, push=20.0)
    env.reset(seed=0)
    forces, ways, was = [], [], 0.0
    for _ in range(160):  # 8 s
        found = env._episodes.randomisation.pushes(0.05)
        assert found is not None
        forces.append(found[0])
        env.step(np.zeros(2, np.float32))
        ways.append(place(env) - was)
        was = place(env)
    size = np.linalg.norm(forces, axis=1)
    assert sorted(set(np.round(size, 9))) == [0.0, 20.0]
    starts = np.flatnonzero(np.diff(size, prepend=0.0) > 0.0)
    assert np.diff(starts) == pytest.approx(40, abs=1)
    assert size.sum() == pytest.approx(20.0 * 4 * 4)
    along = np.array(forces)[starts]
    assert len({tuple(way) for way in along}) == len(starts)
    for start, force in zip(starts, along, strict=True):  # the rail lets it give way along x
        assert ways[start] * force[0] > 0.0


BAD: list[tuple[dict[str, Any], str]] = [
    ({"mass": (1.2, 0.8)}, "mass: wanted a number or"),
    ({"mass": 0.0}, "from 0.1 to 10, got 0.0"),
    ({"friction": "rough"}, "friction: wanted a number"),
    ({"mass": True}, "mass: wanted a number or"),
    ({"mass": (1.0, [2.0])}, "mass: wanted a number or"),
    ({"push": "300"}, "push: wanted a number"),
    ({"push": float("nan")}, "push: wanted a number"),
    ({"action_delay": 1.5}, "wanted whole steps"),
    ({"observation_noise": (0, 1, 2)}, "observation_noise: wanted"),
]


@pytest.mark.parametrize(("given", "text"), BAD)
def test_a_bad_range_says_what_was_wanted(cart: str, given: dict[str, Any], text: str) -> None:
    with pytest.raises(hurcules.Error, match=text):
        SingleEnv(NAME, path=cart, **given)
    env = SingleEnv(NAME, path=cart)
    with pytest.raises(hurcules.Error, match=text):
        env.reset(seed=0, options=given)


def test_without_physics_only_what_needs_none_can_differ() -> None:
    for name in RANGES:
        options = {"fidelity": "kinematic", name: 2 if name == "action_delay" else RANGES[name]}
        if name in PHYSICAL:
            with pytest.raises(hurcules.Error, match=f"{name}: wants physics; fidelity"):
                gym.make("Hurcules/Drive-v0", **options)
        else:
            env = gym.make("Hurcules/Drive-v0", **options)
            assert env.reset(seed=0)[1][f"drawn_{name}"] > 0.0


def test_a_reset_sets_ranges_from_then_on_for_vectors_too() -> None:
    vector = gym.make_vec("Hurcules/Drive-v0", num_envs=3, **FAST)
    vector.reset(seed=0)
    mask = np.array([True, False, False])
    _, info = vector.reset(options={"reset_mask": mask, "mass": (1.1, 1.2)})
    assert ((info["drawn_mass"] > 1.0) == mask).all()
    _, info = vector.reset()
    assert (info["drawn_mass"] > 1.0).all()
    _, info = vector.reset(options={"mass": None})
    assert (info["drawn_mass"] == 1.0).all()
    with pytest.raises(hurcules.Error, match=r"'weight' does not exist.*reset_mask, friction"):
        vector.reset(options={"weight": 3})


def test_a_range_is_an_attribute_that_holds_from_the_next_episode_on() -> None:
    env = gym.make("Hurcules/Drive-v0", **FAST)
    vector = gym.make_vec("Hurcules/Drive-v0", num_envs=2, max_episode_steps=2, **FAST)
    env.set_wrapper_attr("mass", (1.1, 1.2))
    vector.mass = 1.1, 1.2
    assert copy.deepcopy(env).unwrapped.mass == copy.deepcopy(vector).mass == (1.1, 1.2)
    assert (vector.reset(seed=0)[1]["drawn_mass"] > 1.0).all()
    assert env.reset(seed=0)[1]["drawn_mass"] > 1.0
    vector.mass = 2.0
    drawn = [vector.step(vector.action_space.sample())[4]["drawn_mass"] for _ in range(3)]
    assert (drawn[1] < 1.3).all()
    assert (drawn[2] == 2.0).all()
    for one in (env.unwrapped, vector):
        assert [getattr(one, name) for name in NAMES if name != "mass"] == [(1.0, 1.0)] * 2 + [
            (0.0, 0.0)
        ] * 4
        with pytest.raises(hurcules.Error, match="friction: wanted a number or"):
            one.friction = 2.0, 1.0


def test_a_critic_may_see_without_noise() -> None:
    for form in (gym.make, gym.make_vec):
        noisy = form("Hurcules/Drive-v0", observation_noise=0.1, **FAST)
        plain = form("Hurcules/Drive-v0", **FAST)
        action = np.ones_like(noisy.action_space.sample())
        for begins in (True, False):
            told, true = (
                (env.reset(seed=0) if begins else env.step(action))[0] for env in (noisy, plain)
            )
            clean, again = (noisy.unwrapped.observe(noise=noise) for noise in (False, True))
            for name in true:
                assert np.array_equal(clean[name], true[name])
                assert np.array_equal(again[name], told[name])
            assert not np.array_equal(seen(told), seen(true))


def test_stretch_v0_refuses_them() -> None:
    with pytest.raises(hurcules.Error, match="option 'mass' does not exist"):
        gym.make("Hurcules/Stretch-v0", mass=1.2)
