"""Reach on a robot of one's own: two arms of four joints, from MJCF and from MuJoCo's binary.

Strategy: the scripted expert, in the physics and without it; the same bits from both files. Parts
that touch by construction do not keep postures from being found. Bad input says what was wanted.
"""

from pathlib import Path

import gymnasium as gym
import mujoco
import numpy as np
import pytest

import hurcules
import hurcules_envs  # noqa: F401  registers
from closed_chains import FIVE_BAR
from hurcules_envs.robots import load_robot, sample_postures

ARM = """
<body name="{s}_yaw" pos="0 {y} 0.9"><joint name="{s}1" axis="0 0 1" range="-1.6 1.6"/>
  <geom type="cylinder" size="0.06 0.05" mass="3"/>
  <body name="{s}_upper"><joint name="{s}2" axis="0 1 0" range="-1.2 1.2"/>
    <geom type="capsule" fromto="0.10 0 0 0.36 0 0" size="0.05" mass="4"/>
    <body name="{s}_fore" pos="0.4 0 0"><joint name="{s}3" axis="0 1 0" range="0.1 2.4"/>
      <geom type="capsule" fromto="0.06 0 0 0.28 0 0" size="0.04" mass="2"/>
      <body name="{s}_roll" pos="0.3 0 0"><joint name="{s}4" axis="1 0 0" range="-2 2"/>
        <geom type="capsule" fromto="0.06 0 0 0.12 0.05 0" size="0.03" mass="0.5"/>
        <site name="{s}_tip" pos="0.14 0.05 0"/>
      </body></body></body></body>
"""
ROBOT = (
    """<mujoco><compiler angle="radian"/><option timestep="0.002"/>
  <default><joint armature="0.02" damping="0.5"/></default>
  <worldbody><geom name="floor" type="plane" size="3 3 1"/>
    <body name="pole" pos="0 0 0.45"><geom type="cylinder" size="0.05 0.47"/></body>"""
    + ARM.format(s="l", y=0.3)
    + ARM.format(s="r", y=-0.3)
    + "</worldbody><actuator>"
    + "".join(
        f'<motor joint="{side}{i}" ctrlrange="-{most} {most}"/>'
        for side in "lr"
        for i, most in enumerate((80, 120, 60, 20), start=1)
    )
    + "</actuator></mujoco>"
)
FRAMES = ("l_tip", "r_tip")


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, str]:
    """The robot as MJCF and as a binary; its pole stands in the floor."""
    folder: Path = tmp_path_factory.mktemp("robot")
    text, binary = folder / "two_arms.xml", folder / "two_arms.mjb"
    text.write_text(ROBOT)
    mujoco.mj_saveModel(mujoco.MjModel.from_xml_path(str(text)), str(binary), None)
    return str(text), str(binary)


ARM_URDF = """<robot name="arm"><link name="base"/>
  <link name="upper"><inertial><origin xyz="0.2 0 0"/><mass value="2"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="fore"><inertial><origin xyz="0.2 0 0"/><mass value="1"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="hand"/>
  <joint name="turn" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" effort="80" velocity="1"/></joint>
  <joint name="lift" type="revolute"><parent link="upper"/><child link="fore"/><axis xyz="0 1 0"/>
    <origin xyz="0.4 0 0"/><limit lower="-2" upper="2" effort="80" velocity="1"/></joint>
  <joint name="tip" type="fixed"><parent link="fore"/><child link="hand"/>
    <origin xyz="0.4 0 0"/></joint></robot>"""


def test_a_urdf_is_the_robot_that_load_urdf_makes_of_it(tmp_path: Path) -> None:
    # it was read by MuJoCo alone: no motors, no limits of speed, no fixed links
    file, binary = tmp_path / "arm.urdf", tmp_path / "arm.mjb"
    file.write_text(ARM_URDF)
    mujoco.mj_saveModel(hurcules.load_urdf(file), str(binary), None)
    seen = []
    for robot in (file, binary):
        env = gym.make("Hurcules/Reach-v0", fidelity="fast", robot=str(robot), frames=("hand",))
        env.reset(seed=0)
        seen.append([env.step(np.ones(3, np.float32))[0]["achieved_goal"] for _ in range(5)])
        env.close()
    assert np.array_equal(*seen)


@pytest.mark.parametrize("fidelity", ["kinematic", "fast", "exact"])
def test_the_expert_reaches_with_any_robot(files: tuple[str, str], fidelity: str) -> None:
    env = gym.make_vec(
        "Hurcules/Reach-v0", num_envs=8, fidelity=fidelity, robot=files[0], frames=FRAMES
    )
    observation, info = env.reset(seed=0)
    succeeded, excess = np.zeros(8, dtype=bool), 0.0
    for _ in range(99):
        way = observation["desired_goal"] - observation["achieved_goal"]
        observation, _, _, _, info = env.step(np.clip(10 * way, -1, 1).astype(np.float32))
        succeeded |= info["is_success"].astype(bool)
        excess = max(excess, float(info["limit_excess"].max()))
    assert succeeded.sum() >= 7
    assert excess < 5e-3
    env.close()


def test_a_binary_model_has_the_same_bits(files: tuple[str, str]) -> None:
    seen = []
    for file in files:
        env = gym.make("Hurcules/Reach-v0", fidelity="fast", robot=file, frames=FRAMES)
        env.reset(seed=3)
        for _ in range(10):
            observation, *_ = env.step(np.full(6, 0.3, np.float32))
        seen.append(observation)
        env.close()
    for name, value in seen[0].items():
        np.testing.assert_array_equal(value, seen[1][name])


def test_a_path_and_one_hand_will_do(files: tuple[str, str]) -> None:
    env = gym.make(
        "Hurcules/Reach-v0", fidelity="kinematic", robot=Path(files[0]), frames=("l_tip",)
    )
    assert env.action_space.shape == (3,)
    env.close()


def test_a_file_that_was_edited_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "robot.xml"
    path.write_text(ROBOT)
    once = load_robot(path, FRAMES)
    assert load_robot(path, FRAMES) is once  # its pairs and postures are found once
    path.write_text(ROBOT.replace('mass="4"', 'mass="5"'))
    env = gym.make("Hurcules/Reach-v0", fidelity="kinematic", robot=path, frames=FRAMES)
    assert env.unwrapped.environment.simulation.model.body("l_upper").mass == 5.0
    assert once.model.body("l_upper").mass == 4.0


def test_a_second_environment_of_a_robot_has_the_bits_of_the_first(files: tuple[str, str]) -> None:
    """Its tasks are copies of those that are kept."""
    rewards = []
    for _ in range(2):
        env = gym.make("Hurcules/Reach-v0", fidelity="kinematic", robot=files[0], frames=FRAMES)
        env.reset(seed=1)
        rewards.append([env.step(np.full(6, 0.7, np.float32))[1] for _ in range(30)])
    assert rewards[0] == rewards[1]


def test_a_file_that_is_no_model_says_so(tmp_path: Path) -> None:
    broken = tmp_path / "broken.mjb"
    broken.write_bytes(b"nothing")
    with pytest.raises(hurcules.Error, match=r"broken\.mjb"):
        gym.make("Hurcules/Reach-v0", robot=str(broken), frames=FRAMES)


BALL = """<mujoco><compiler angle="radian"/><default><geom type="capsule" size="0.03"/></default>
  <worldbody><body pos="0 0 1"><joint name="ball" type="ball" range="0 1.5" armature="0.02"/>
    <geom fromto="0 0 0 .4 0 0"/><body pos=".4 0 0">
      <joint name="elbow" axis="0 1 0" range="0.1 2.4" armature="0.02"/>
      <geom fromto=".07 0 0 .3 0 0"/><site name="hand" pos=".3 0 0"/></body></body></worldbody>
  <actuator><motor joint="ball" gear="1 0 0"/><motor joint="ball" gear="0 1 0"/>
    <motor joint="ball" gear="0 0 1"/><motor joint="elbow"/></actuator></mujoco>"""


@pytest.mark.parametrize("text", [BALL, FIVE_BAR], ids=["ball joint", "closed chain"])
def test_the_expert_reaches_with_joints_of_another_kind(tmp_path: Path, text: str) -> None:
    # a ball joint was a KeyError, the loop of a closed chain was open at most starts and goals
    path = tmp_path / "robot.xml"
    path.write_text(text)
    env = gym.make("Hurcules/Reach-v0", robot=path, frames=("hand",))
    reached = []
    for seed in range(4):
        observation, info = env.reset(seed=seed)
        for _ in range(99):
            way = observation["desired_goal"] - observation["achieved_goal"]
            observation, _, _, _, info = env.step(np.clip(10 * way, -1, 1).astype(np.float32))
        reached.append(bool(info["is_success"]))
    env.close()
    assert all(reached)


def test_the_postures_of_a_closed_chain_are_closed_in_one_assembly(tmp_path: Path) -> None:
    path = tmp_path / "five_bar.xml"
    path.write_text(FIVE_BAR)
    setup = load_robot(path, ("hand",))
    data = mujoco.MjData(setup.model)
    for qpos in sample_postures(setup).qpos:
        data.qpos[:] = qpos
        mujoco.mj_forward(setup.model, data)
        assert np.abs(data.efc_pos[: data.ne]).max() < 1e-6
        one, two, hand = (data.body("one").xpos, data.body("two").xpos, data.site("hand").xpos)
        assert np.cross(two - one, hand - one)[1] < 0.0  # the hand stays on its side of both elbows
