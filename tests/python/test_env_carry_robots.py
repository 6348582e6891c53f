"""Carry on a robot of one's own: two arms of seven joints from MJCF.

Strategy: the expert and the policy of the package, which knows the manipulation robot alone, carry;
what is scaled is what `info` says. What cannot carry is refused with what was wanted and what came.
Not tested: robots of other packages (docs/environments.md has what was measured).
"""

from pathlib import Path
from typing import Any

import gymnasium as gym
import mujoco
import numpy as np
import pytest

import hurcules
import hurcules_envs  # noqa: F401  registers
from hurcules_envs.contact import ContactEnvironment
from hurcules_envs.policy import Policy
from hurcules_envs.registry import make_environment
from hurcules_envs.single import SingleEnv

ARM = """
<body name="{s}_yaw" pos="0 {y} 1.1"><joint name="{s}1" axis="0 0 1" range="-2.8 2.8"/>
  <geom type="sphere" size="0.06" mass="3"/>
  <body name="{s}_upper"><joint name="{s}2" axis="0 1 0" range="-1.9 1.9"/>
    <joint name="{s}3" axis="1 0 0" range="-2.8 2.8"/>
    <geom type="capsule" fromto="0.1 0 0 0.3 0 0" size="0.05" mass="4"/>
    <body name="{s}_fore" pos="0.38 0 0"><joint name="{s}4" axis="0 1 0" range="0.05 2.6"/>
      <joint name="{s}5" axis="1 0 0" range="-2.8 2.8"/>
      <geom type="capsule" fromto="0.1 0 0 0.26 0 0" size="0.04" mass="2.5"/>
      <body name="{s}_wrist" pos="0.34 0 0"><joint name="{s}6" axis="0 1 0" range="-2 2"/>
        <joint name="{s}7" axis="0 0 1" range="-2 2"/>
        <geom type="sphere" size="0.03" pos="0.05 0 0" mass="0.8"/>
        <site name="{s}_hand" pos="0.08 0 0"/>
      </body></body></body></body>
"""
MOST = (250, 250, 200, 200, 80, 80, 80)  # [N m]


def two_arms(share: float = 1.0, apart: float = 0.3) -> str:
    """The robot as MJCF, its motors with a share of their efforts."""
    arms = ARM.format(s="l", y=apart) + ARM.format(s="r", y=-apart)
    motors = "".join(
        f'<motor joint="{side}{i}" ctrlrange="-{share * most} {share * most}"/>'
        for side in "lr"
        for i, most in enumerate(MOST, start=1)
    )
    return f"""<mujoco><compiler angle="radian" autolimits="true"/>
      <default><joint armature="0.1" damping="2"/></default>
      <worldbody><geom name="floor" type="plane" size="3 3 1"/>{arms}</worldbody>
      <actuator>{motors}</actuator></mujoco>"""


FRAMES = ("l_hand", "r_hand")
CARRY = "hurcules_envs.carry:Carry"


def written(folder: Path, text: str) -> str:
    path = folder / "two_arms.xml"
    path.write_text(text)
    return str(path)


@pytest.fixture(scope="module")
def options(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    path = written(tmp_path_factory.mktemp("robot"), two_arms())
    return {"fidelity": "fast", "robot": path, "frames": FRAMES, "palm": "x"}


def environment_of(options: dict[str, Any]) -> ContactEnvironment:
    environment = make_environment(CARRY, options)
    assert isinstance(environment, ContactEnvironment)
    return environment


@pytest.mark.parametrize("who", ["expert", "policy"])
def test_the_box_comes_to_its_goal(options: dict[str, Any], who: str) -> None:
    """The policy saw the manipulation robot alone."""
    vector = gym.make_vec("Hurcules/Carry-v0", num_envs=6, threads=2, **options)
    policy, unwrapped = Policy("Carry-v0"), vector.unwrapped
    seen, info = vector.reset(seed=100)
    policy.check("Carry-v0", vector.single_observation_space, vector.single_action_space)
    assert info["mass"].max() < 60.0 * 0.5 and info["mass"].min() > 0.1
    done, over, excess = np.zeros(6, dtype=bool), np.zeros(6, dtype=bool), 0.0
    for _ in range(200):
        action = policy(seen)
        if who == "expert":
            action = unwrapped.environment.expert(unwrapped.numbers).astype(np.float32)
        seen, _, terminated, _, info = vector.step(action)
        done |= info["is_success"].astype(bool) & ~over
        excess = max(excess, float(info["limit_excess"][~over].max(initial=0.0)))
        over |= terminated
        if over.all():
            break
    vector.close()
    assert done.sum() >= 5
    assert excess < 5e-3


def test_spaces_are_those_of_the_manipulation_robot(options: dict[str, Any]) -> None:
    own = SingleEnv(CARRY, **options)
    other = gym.make("Hurcules/Carry-v0", fidelity="fast").unwrapped
    assert isinstance(other, SingleEnv)
    assert own.observation_space == other.observation_space
    assert own.action_names == other.action_names
    share = own.action_scale[-1] / other.action_scale[-1]
    assert 0.003 < share < 1.0
    assert np.array_equal(own.action_scale[:-1], other.action_scale[:-1])
    for seed in range(5):
        mass = own.reset(seed=seed)[1]["mass"]
        assert mass == pytest.approx(share * other.reset(seed=seed)[1]["mass"], rel=1e-12)


def test_loads_follow_the_motors(options: dict[str, Any], tmp_path: Path) -> None:
    """At one place and in one posture: half the effort bears less than half the load."""
    first = environment_of(options)
    place = first._place  # type: ignore[attr-defined]
    half = written(tmp_path, two_arms(0.5))
    second = environment_of({**options, "robot": half, "place": place})
    assert second.actions["squeeze"] < 0.55 * first.actions["squeeze"]
    assert second._place == place  # type: ignore[attr-defined]


def test_the_same_file_gives_the_same_bits(options: dict[str, Any]) -> None:
    seen = []
    for _ in range(2):
        env = SingleEnv(CARRY, **options)
        env.reset(seed=3)
        for _ in range(25):
            action = env.environment.expert(env.numbers)[0].astype(np.float32)
            observation, *_ = env.step(action)
        seen.append(observation)
    assert np.array_equal(*seen)


def test_the_palms_are_where_the_observation_says(options: dict[str, Any]) -> None:
    """60 mm behind the faces of the pads, which start 0.28 m from the middle of the table."""
    env = SingleEnv(CARRY, **options)
    observation, info = env.reset(seed=0)
    model = env.environment.simulation.model
    assert model.geom("left_palm_pad").size[0] == 0.02
    for hand, side in ((observation[:3], 1.0), (observation[3:6], -1.0)):
        assert hand[1] == pytest.approx(side * 0.34, abs=0.025)
        assert abs(hand[0]) < 0.025
    assert info["half_y"] < 0.28


def test_both_arms_are_the_robot_whose_masses_are_drawn(options: dict[str, Any]) -> None:
    """They are two trees; the box is no part of them."""
    env = gym.make("Hurcules/Carry-v0", mass=2.0, **options).unwrapped
    assert isinstance(env, SingleEnv)
    env.reset(seed=0)
    nominal, drawn = env.environment.simulation.model, env._episodes._models[0]
    for name in ("l_upper", "r_upper"):
        assert drawn.body(name).mass == 2.0 * nominal.body(name).mass
    assert drawn.body("box").mass == env._episodes.memory["mass"][0, 0]


def test_what_cannot_carry_is_refused(options: dict[str, Any], tmp_path: Path) -> None:
    def refused(match: str, **given: Any) -> None:
        with pytest.raises(hurcules.Error, match=match):
            make_environment(CARRY, {**options, **given})

    refused("wanted frames=", frames=("l_hand",))
    refused("one or two hands, got", frames=("l_hand", "l_hand"))
    refused("'no_hand'", frames=("l_hand", "no_hand"))
    refused("palm 'w' does not exist", palm="w")
    refused("place: wanted x, y, z", place=(0.3, 0.0))
    refused("place: wanted x, y, z", place="ahead")
    refused("come to both sides of a box", place=(5.0, 0.0, 1.0))
    refused("come to both sides of a box", frames=("r_hand", "l_hand"), place=(0.4, 0.0, 0.9))
    refused("wanted an MJCF file, .* binary", robot=_binary(options["robot"], tmp_path))
    refused("wanted an MJCF file, .* a URDF", robot=_urdf(tmp_path), frames=("a", "b"))
    place = environment_of(options)._place  # type: ignore[attr-defined]
    refused("wanted motors that hold", robot=written(tmp_path, two_arms(0.01)), place=place)
    refused("scoops", robot="rescue", frames=None)
    refused("frames: robot 'manipulation' has its own", robot="manipulation")
    refused("path of a model", robot="no_such_robot.xml")


def _urdf(folder: Path) -> str:
    link = """<link name="{}"><inertial><mass value="1"/>
      <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
      <joint name="{}" type="continuous"><parent link="base"/><child link="{}"/></joint>"""
    links = link.format("a", "j", "a") + link.format("b", "k", "b")
    path = folder / "arms.urdf"
    path.write_text(f'<robot name="arms"><link name="base"/>{links}</robot>')
    return str(path)


def _binary(robot: str, folder: Path) -> str:
    path = str(folder / "two_arms.mjb")
    mujoco.mj_saveModel(mujoco.MjModel.from_xml_path(robot), path, None)
    return path
