"""The environments of contact, in "fast" where that is enough.

Gymnasium's checker, bits alone, side by side and after a state, tables against spaces, experts, bad
input. That hold, constant and random actions do not solve them, and the experts over 40 seeds, is
measured by benchmarks/contact_environments.py.
"""

import re
import warnings
from typing import Any

import gymnasium as gym
import mujoco
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from numpy.typing import NDArray

import hurcules
import hurcules.casualties
import hurcules_envs  # noqa: F401  registers
from environments import assert_tables_are_true
from hurcules_envs.registry import make_environment
from hurcules_envs.single import SingleEnv

CLASSES = {
    name: f"hurcules_envs.{name.lower()}:{name}"
    for name in ("Press", "Valve", "Door", "Carry", "Lift")
}
IDS = [f"Hurcules/{name}-v0" for name in CLASSES]
FAST = {"fidelity": "fast"}


def single(name: str, **options: Any) -> SingleEnv:
    env = gym.make(name, **(FAST | options)).unwrapped
    assert isinstance(env, SingleEnv)
    return env


def expert(env: SingleEnv) -> NDArray[np.float32]:
    return env.environment.expert(env.numbers)[0].astype(np.float32)


@pytest.mark.parametrize("name", [*IDS, *(f"Hurcules/{name}Joint-v0" for name in CLASSES)])
def test_gymnasiums_checker_has_nothing_to_say(name: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        env = gym.make(name, **FAST)
        assert len(env.unwrapped.action_units) == len(env.unwrapped.action_names)
        assert set(env.unwrapped.action_units) <= {"m/s", "rad/s", "N"}
        check_env(env.unwrapped, skip_render_check=True)
        env.close()


@pytest.mark.parametrize("name", IDS)
def test_the_tables_in_the_text_are_true(name: str) -> None:
    env = single(name)
    assert_tables_are_true(env)


@pytest.mark.parametrize("name", IDS)
def test_the_expert_succeeds_and_the_terms_sum_to_the_reward(name: str) -> None:
    env = single(name, fidelity="exact")
    wanted = gym.spec(name).max_episode_steps or 0
    env.reset(seed=100)
    for _ in range(wanted):
        _, reward, terminated, _, info = env.step(expert(env))
        terms = [info[f"reward_{term}"] for term in env.environment.terms]
        # Python's sum carries rounding along from 3.12 on
        assert reward == pytest.approx(sum(terms), rel=1e-12, abs=1e-15)
        if terminated:
            break
    assert info["is_success"]
    assert not info["failed"]
    assert info["ending"] == int(hurcules.Ending.Completed)
    assert info["limit_excess"] < 0.01
    assert info["reward_success"] == 10.0


@pytest.mark.parametrize("name", IDS)
def test_three_side_by_side_have_the_bits_that_they_have_alone(name: str) -> None:
    vector = gym.make_vec(name, num_envs=3, threads=2, **FAST)
    singles = [single(name) for _ in range(3)]
    together = vector.reset(seed=7)[0]
    assert all(np.array_equal(e.reset(seed=7 + i)[0], together[i]) for i, e in enumerate(singles))
    generator = np.random.default_rng(0)
    for _ in range(15):
        actions = generator.uniform(-1, 1, vector.action_space.shape).astype(np.float32)
        seen, reward, *_ = vector.step(actions)
        for i, env in enumerate(singles):
            alone = env.step(actions[i])
            assert np.array_equal(alone[0], seen[i])
            assert alone[1] == reward[i]


@pytest.mark.parametrize("name", IDS)
def test_a_state_goes_on_with_the_same_bits_in_another_environment(name: str) -> None:
    one, other = single(name), single(name)
    one.reset(seed=3)
    other.reset(seed=4)
    for _ in range(40):  # until it touches
        one.step(expert(one))
    other.set_state(one.get_state())
    for _ in range(20):
        action = expert(one)
        first, second = one.step(action), other.step(action)
        assert np.array_equal(first[0], second[0])
        assert first[1:4] == second[1:4]
        assert first[4] == second[4]
        if first[2]:
            break


@pytest.mark.parametrize("name", IDS)
def test_a_reset_leaves_nothing_of_the_episode_before(name: str) -> None:
    env = single(name)
    runs = []
    for _ in range(2):
        env.reset(seed=5)
        runs.append([env.step(expert(env))[0] for _ in range(40)])
    assert all(np.array_equal(one, other) for one, other in zip(*runs, strict=True))


@pytest.mark.parametrize("name", IDS)
def test_what_is_drawn_is_told_and_differs(name: str) -> None:
    env = single(name)
    first, second = env.reset(seed=0)[1], env.reset(seed=1)[1]
    drawn = {key for key in first if key in env.environment.memory and key != "angle"}
    assert len(drawn) >= 2
    assert all(first[key] != second[key] for key in drawn)


@pytest.mark.parametrize("path", CLASSES.values())
def test_bad_options_are_refused_with_what_was_wanted(path: str) -> None:
    with pytest.raises(hurcules.Error, match=re.escape("has no physics")):
        make_environment(path, {"fidelity": "kinematic"})
    with pytest.raises(hurcules.Error, match="fidelity"):
        make_environment(path, {"fidelity": "slow"})
    with pytest.raises(hurcules.Error, match="10 to 100 Hz"):
        make_environment(path, {"rate": 5.0})
    with pytest.raises(hurcules.Error, match="option"):
        make_environment(path, {"colour": "red"})


@pytest.mark.parametrize("path", CLASSES.values())
def test_sparse_rewards_say_nothing_on_the_way(path: str) -> None:
    env = SingleEnv(path, sparse=True, **FAST)
    env.reset(seed=0)
    assert [env.step(np.zeros(env.action_space.shape, np.float32))[1] for _ in range(5)] == [0] * 5


def test_the_reading_of_a_force_task_is_a_quantity() -> None:
    env = single("Hurcules/Press-v0")
    env.reset(seed=0)
    quantity = hurcules.Quantities(env.simulation, ["force/down"])
    before = env.simulation.read(quantity)[0]
    for _ in range(60):
        env.step(expert(env))
    assert abs(before) < 2.5  # in the air: below what counts as contact
    assert 5.0 < env.simulation.read(quantity)[0] < 60.0
    with pytest.raises(hurcules.Error, match="this task reads no force"):
        hurcules.Quantities(env.simulation, ["force/slide"])


@pytest.mark.parametrize("name", CLASSES)
def test_the_twin_that_commands_joints_is_the_same_but_for_its_action(name: str) -> None:
    """Same start, same limits: what differs is who moves the body."""
    env, twin = single(f"Hurcules/{name}-v0"), single(f"Hurcules/{name}Joint-v0")
    joints = [one for one in twin.action_names if one.startswith("joints_")]
    robot = hurcules.Robot(twin.environment.simulation.model)
    assert len(joints) == len(robot.coordinate_names)
    assert np.array_equal(
        twin.action_scale[: len(joints)], [min(one.max_velocity, 1.0) for one in robot.coordinates]
    )
    names = [group.name for group in env.environment.observation if group.name != "lead"]
    assert [group.name for group in twin.environment.observation] == [*names, "q"]
    one, other = env.reset(seed=1)[0], twin.reset(seed=1)[0]
    size = len(robot.coordinate_names)
    assert np.allclose(other[-size:], twin.numbers["q"][0], atol=1e-6)
    lead = next((g.size for g in env.environment.observation if g.name == "lead"), 0)
    assert len(other) == len(one) - lead + size
    action = np.zeros(twin.action_space.shape, np.float32)
    action[joints.index("joints_3")] = 1.0
    before = twin.numbers["q"].copy()
    for _ in range(10):
        *_, info = twin.step(action)
    moved = (twin.numbers["q"] - before)[0]
    assert abs(moved[3]) > 0.2 * twin.action_scale[3] and abs(moved).argmax() == 3
    assert info["commanded_excess"] == 0.0


def test_the_physics_of_an_episode_can_be_read_with_mujoco() -> None:
    env = single("Hurcules/Press-v0")
    env.reset(seed=0)
    for _ in range(10):
        env.step(expert(env))
    model, data = env.model, env.data
    assert np.array_equal(data.qpos, env.qpos)
    borne, force = 0.0, np.zeros(6)
    for i in range(data.ncon):
        if "floor" in (model.geom(geom).name for geom in data.contact[i].geom):
            mujoco.mj_contactForce(model, data, i, force)
            borne += force[0]
    root = model.body_rootid[model.body("pelvis").id]
    weight = -model.opt.gravity[2] * model.body_subtreemass[root]
    assert borne == pytest.approx(weight, rel=0.05)
    before = env.get_state()
    data.qpos[:] = 0.0  # a copy
    assert np.array_equal(env.get_state(), before)


@pytest.mark.parametrize("name", CLASSES)
def test_balance_and_distances_come_before_what_is_commanded(name: str) -> None:
    for suffix in ("", "Joint"):
        env = single(f"Hurcules/{name}{suffix}-v0", safe=True)
        levels = list(env.simulation.levels)
        first = [level for level in levels if level not in ("joint", "limits")][:3]
        assert first[:2] == ["balance", "zero moment"]
        assert "self_collision" in first[2] and "obstacles" in first[2]
        without = single(f"Hurcules/{name}{suffix}-v0", safe=False).simulation.levels
        assert [level for level in levels if level not in first] == list(without)


def test_a_box_is_carried_without_an_elbow_at_the_trunk() -> None:
    """Seed 0 of `fast`: with the limits alone an arm met the trunk, and the box fell."""
    touched, succeeded = {}, {}
    for safe in (False, True):
        env = single("Hurcules/Carry-v0", safe=safe)
        env.reset(seed=0)
        touched[safe], terminated = 0, False
        while not terminated and touched[safe] < 300:
            *_, terminated, _, info = env.step(expert(env))
            touched[safe] += int(info["self_contacts"] > 0)
        succeeded[safe] = info["is_success"]
    assert touched[False] > 0
    assert touched[True] == 0
    assert succeeded[True]


def test_levels_are_on_but_for_press() -> None:
    for name in CLASSES:
        levels = single(f"Hurcules/{name}-v0").simulation.levels
        assert ("zero moment" in levels) == (name != "Press")


def test_only_tracks_and_scoops_may_come_near_in_a_scene() -> None:
    """Scoops met the head, and each other, where all kept the 20 mm that the path wants."""
    for name, floor in (("Press", {"R_larm": 0.04}), ("Lift", {"L_uarm": 0.02, "R_uarm": 0.02})):
        controller = single(f"Hurcules/{name}-v0", safe=True).simulation.controller
        margins = {
            frozenset(pair): (task.name, task.lower[0])
            for task in controller.tasks
            if isinstance(task, hurcules.DistanceTask)
            for pair in task.pairs(controller.plan)
        }
        assert margins[frozenset(("L_scoop_flange", "R_scoop_flange"))][1] == 0.12
        assert margins[frozenset(("L_scoop_flange", "head"))][1] == 0.12
        assert margins[frozenset(("R_scoop_root", "R_lower_toe"))][1] == 0.02
        of = {one.rsplit(" ", 1)[1]: lower for one, lower in margins.values() if " of " in one}
        assert of == floor
        assert (frozenset(("R_scoop_tip", "floor")) in margins) == (name == "Press")


def test_a_side_load_brings_no_two_fingers_together() -> None:
    env = single("Hurcules/Door-v0")
    env.reset(seed=0)
    model, data = env.model, env.data
    geoms = [model.geom(f"R_finger_{i}").id for i in "12"]
    data.xfrc_applied[model.body("R_finger_2").id] = [0.0, -600.0, 0.0, 0.0, 0.0, 0.0]
    data.xfrc_applied[model.body("R_hand").id] = [0.0, 600.0, 0.0, 0.0, 0.0, 0.0]
    for _ in range(50):
        mujoco.mj_step(model, data)
    assert mujoco.mj_geomDistance(model, data, *geoms, 1.0, None) > 0.004


def test_a_trunk_that_is_led_into_the_table_stops_before_it() -> None:
    controller = single("Hurcules/Carry-v0").simulation.controller
    table = controller.task("table")
    assert {pair[0] for pair in table.pairs(controller.plan)} >= {"torso", "L_uarm", "R_uarm"}
    assert set(table.lower) == {0.06}


def test_what_the_robot_presses_on_a_person_is_told_and_costs() -> None:
    env = single("Hurcules/Lift-v0")
    _, info = env.reset(seed=0)
    assert info["harmless"] == 1.0 and info["contact_share"] == 0.0
    most = 0.0
    for _ in range(175):  # the blades are under him, and he still lies
        *_, info = env.step(expert(env))
        lying = env.environment.observe(env.numbers)["lying"][0, 0]
        share = info["contact_share"] if lying > 0.15 else 0.0
        most = max(most, share)
        over = max(share - 1.0, 0.0)
        assert info["reward_harm"] == pytest.approx(-0.1 * 0.05 * over)
        assert info["cost"] == float(over > 0.0)
        assert info["harmless"] == float(most <= 1.0)
        assert info["contact_share_most"] == most
    model, data = env.model, env.data  # contacts and sensors of one instant
    told = hurcules.casualties.contact_forces(model, data)
    assert max(forces["robot"] for forces in told.values()) > 10.0
    for region, forces in told.items():
        normal = data.sensor(f"casualty_touch_{region}").data.reshape(-1, 3)[:, 0]
        assert np.abs(normal).sum() == pytest.approx(forces["robot"], rel=1e-6, abs=1e-9)
    assert most > 0.5
    assert 0.0 < info["head_mps2"] <= info["head_mps2_most"] < 98.1
