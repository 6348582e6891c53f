"""Episodes that differ in their models, and actions that are no channels: a cart and a load."""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

import mujoco
import numpy as np
import pytest
from numpy.typing import NDArray

import hurcules
import hurcules_envs
from hurcules_envs.environment import Array, Environment, Group, Numbers, Start
from hurcules_envs.episodes import Episodes
from hurcules_envs.single import SingleEnv
from hurcules_envs.vector import NativeVectorEnv

CART = """
<mujoco>
  <option timestep="0.005"/>
  <worldbody>
    <body name="cart">
      <joint name="rail" type="slide" axis="1 0 0" range="-2 2"/>
      <geom size="0.1" mass="1"/>
    </body>
    <body name="load" pos="0 0 1">
      <joint name="swing" type="slide" axis="1 0 0" stiffness="9"/>
      <geom size="0.1" mass="2"/>
    </body>
  </worldbody>
  <actuator><motor name="rail" joint="rail" ctrlrange="-50 50"/></actuator>
</mujoco>
"""


class Cart(Environment):
    """A cart on a rail; beside it a load on a spring, released 0.1 m off, whose mass differs."""

    task_description = "Move the cart."
    terms = ("place",)
    memory = MappingProxyType({"mass": 1, "seen": 1})
    parameters = ("mass",)
    components = MappingProxyType({"push": ("push_there", "push_back")})
    quantities = ("position/cart", "joint/swing")
    observation = (Group("swing", 1, "m", 5.0), Group("mass", 1, "kg", 10.0))

    def __init__(self, path: str) -> None:
        self.actions = {"push": np.array([0.5, 0.25])}
        model = mujoco.MjModel.from_xml_path(path)
        robot = hurcules.Robot(model, ["rail"])
        hand = hurcules.PositionTask("hand", robot, "cart", axes=[[1, 0, 0]])
        channels = {"hand": hurcules.Twist(hand, 1.0)}
        controller = hurcules.WholeBodyController(robot, [hand], channels)
        self.simulation = hurcules.Simulation(model=model, controller=controller, record=False)

    def start(self, generator: np.random.Generator) -> Start:
        """A mass."""
        mass = generator.uniform(1.0, 4.0)
        return Start(np.array([0.0, 0.1]), {"mass": mass}, {"mass": mass})

    def configure(self, model: mujoco.MjModel, values: Mapping[str, Array]) -> None:
        """The mass of the load."""
        model.body("load").mass = values["mass"]
        mujoco.mj_setConst(model, mujoco.MjData(model))

    def command(self, action: Mapping[str, Array], numbers: Numbers) -> Mapping[str, Array]:
        """There minus back."""
        numbers.memory["seen"][:] = numbers["joint/swing"]
        return {"hand": action["push"][:, :1] - action["push"][:, 1:]}

    def observe(self, numbers: Numbers) -> Mapping[str, Array]:
        """Place and mass of the load."""
        return {"swing": numbers["joint/swing"], "mass": numbers["mass"]}

    def reward(self, numbers: Numbers) -> Mapping[str, Array]:
        """The place of the cart."""
        return {"place": numbers["position/cart"][:, 0]}

    def succeeded(self, numbers: Numbers) -> NDArray[np.bool_]:
        """Never."""
        return np.zeros(len(numbers.action), bool)


@pytest.fixture
def cart(tmp_path: Path) -> str:
    path = tmp_path / "cart.xml"
    path.write_text(CART)
    return str(path)


NAME = f"{__name__}:Cart"


def test_each_episode_swings_with_its_own_mass(cart: str) -> None:
    env = NativeVectorEnv(NAME, 3, path=cart)
    seen, info = env.reset(seed=0)
    assert len(set(info["mass"])) == 3
    assert np.allclose(seen[:, 1], info["mass"])
    for _ in range(10):
        seen, *_ = env.step(np.zeros((3, 2), np.float32))
    swing = 0.1 * np.cos(np.sqrt(9.0 / info["mass"]) * 0.5)  # hand-calculated
    assert np.allclose(seen[:, 0], swing, atol=2e-3)
    assert env.environment.simulation.model.body("load").mass == 2.0


def test_a_vector_has_the_bits_of_single_episodes_with_other_models(cart: str) -> None:
    action = np.full(2, 0.5, np.float32)
    env = NativeVectorEnv(NAME, 3, threads=2, path=cart)
    env.reset(seed=4)
    rows = [env.step(np.tile(action, (3, 1)))[0] for _ in range(5)]
    for i in range(3):
        single = SingleEnv(NAME, path=cart)
        single.reset(seed=4 + i)
        assert all(np.array_equal(single.step(action)[0], row[i]) for row in rows)


def test_a_state_brings_its_model_with_it(cart: str) -> None:
    one, other = SingleEnv(NAME, path=cart), SingleEnv(NAME, path=cart)
    one.reset(seed=1)
    other.reset(seed=2)
    action = np.full(2, 0.5, np.float32)
    one.step(action)
    other.set_state(one.get_state())
    for _ in range(20):
        first, second = one.step(action), other.step(action)
        assert np.array_equal(first[0], second[0])
        assert first[4] == second[4]


def test_an_action_that_is_no_channel_is_turned_into_commands(cart: str) -> None:
    env = SingleEnv(NAME, path=cart)
    assert env.action_names == ["push_there", "push_back"]
    assert env.action_scale.tolist() == [0.5, 0.25]
    env.reset(seed=0)
    for _ in range(20):
        env.step(np.array([1.0, 1.0], np.float32))  # 0.5 - 0.25 m/s for a second
    assert float(env.simulation.read(hurcules.Quantities(env.simulation, ["joint/rail"]))[0]) == (
        pytest.approx(0.25, abs=0.02)
    )


def test_parameters_that_nobody_writes_are_an_error(cart: str) -> None:
    class Forgetful(Cart):
        configure = Environment.configure

    with pytest.raises(NotImplementedError, match="no configure"):
        Episodes(Forgetful(cart), 1, 1).reset()


class Ends(Cart):
    """Heavy loads fly apart; a cart beyond 18 mm has failed, at 10 mm it is done."""

    def configure(self, model: mujoco.MjModel, values: Mapping[str, Array]) -> None:
        """A spring that pushes, of heavy loads."""
        super().configure(model, values)
        model.jnt_stiffness[1] = -1e7 if values["mass"] > 2.5 else 9.0

    def succeeded(self, numbers: Numbers) -> NDArray[np.bool_]:
        """Between the two places."""
        place = numbers["position/cart"][:, 0]
        return (place > 0.01) & (place < 0.018)

    def ended(self, numbers: Numbers) -> NDArray[np.bool_]:
        """Success ends it."""
        return self.succeeded(numbers)

    def failed(self, numbers: Numbers) -> NDArray[np.bool_]:
        """Beyond."""
        return numbers["position/cart"][:, 0] >= 0.018


ENDS = f"{__name__}:Ends"


def test_info_says_why_an_episode_is_over(cart: str) -> None:
    vector = NativeVectorEnv(ENDS, 6, path=cart)
    _, info = vector.reset(seed=0)
    assert (info["ending"] == 0).all()
    heavy = info["mass"] > 2.5
    speeds = np.zeros((6, 2), np.float32)
    speeds[~heavy, 0] = np.linspace(0.0, 1.0, int((~heavy).sum()))
    *_, terminated, _, info = vector.step(speeds)
    endings = [hurcules.Ending(one).name for one in info["ending"]]
    place = vector.numbers["position/cart"][:, 0]
    wanted = np.where(place >= 0.018, "Missed", np.where(place > 0.01, "Completed", "Running"))
    assert endings == np.where(heavy, "Diverged", wanted).tolist()
    assert set(endings) == {"Running", "Diverged", "Completed", "Missed"}
    assert (terminated == (info["ending"] > 0)).all()
    assert (info["failed"] == (info["ending"] > 1)).all()
    for i in range(6):
        env = SingleEnv(ENDS, path=cart)
        env.reset(seed=i)
        assert env.step(speeds[i])[4]["ending"] == info["ending"][i]


def test_a_limit_of_steps_has_an_ending_of_its_own(cart: str) -> None:
    known = {one.name: int(one) for one in hurcules_envs.Ending}
    limit = known.pop("TimeLimit")
    assert known == {name: int(one) for name, one in hurcules.Ending.__members__.items()}
    vector = NativeVectorEnv(f"{__name__}:Cart", 2, max_episode_steps=3, path=cart)
    vector.reset(seed=0)
    for step in range(3):
        _, _, terminated, truncated, info = vector.step(np.zeros((2, 2), np.float32))
        assert not terminated.any()
        assert (truncated == (step == 2)).all()
        assert (info["ending"] == np.where(truncated, limit, 0)).all()
        assert not info["failed"].any()
