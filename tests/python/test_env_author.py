"""What the author of an environment gets wrong is told where it happens, with what was wanted.

Strategy: a cart on a rail, right but for one attribute or method. Not tested: what Python or
`hurcules.Quantities` say themselves (an abstract method that is missing, an unknown quantity).
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Mapping
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import gymnasium
import mujoco
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import hurcules
import hurcules_envs
from hurcules_envs.drive import Drive
from hurcules_envs.environment import Environment, Group, Start, tick_of
from hurcules_envs.episodes import Episodes
from hurcules_envs.evaluation import evaluate
from hurcules_envs.onnx_file import Graph, Node, write
from hurcules_envs.registry import make_environment
from hurcules_envs.single import SingleEnv
from hurcules_envs.vector import NativeVectorEnv

CART = """
<mujoco>
  <worldbody>
    <body name="cart"><joint name="rail" type="slide" axis="1 0 0"/><geom size="0.1"/></body>
  </worldbody>
  <actuator><motor name="rail" joint="rail" ctrlrange="-50 50"/></actuator>
</mujoco>
"""


class Cart(Environment):
    """Goes to a place."""

    task_description = "Go to the place."
    terms = ("distance",)
    quantities = ("position/cart", "velocity/cart")
    observation = (Group("way", 1, "m", 5.0), Group("velocity/cart", 3, "m/s", 5.0))
    memory = MappingProxyType({"place": 1})

    def __init__(self) -> None:
        self.actions = {"hand": 1.0}
        model = mujoco.MjModel.from_xml_string(CART)
        robot = hurcules.Robot(model, ["rail"])
        hand = hurcules.PositionTask("hand", robot, "cart", axes=[[1, 0, 0]])
        channels = {"hand": hurcules.Twist(hand, 1.0)}
        controller = hurcules.WholeBodyController(robot, [hand], channels)
        self.simulation = hurcules.Simulation(model=model, controller=controller, record=False)

    def start(self, generator: np.random.Generator) -> Start:
        """A place."""
        place = generator.uniform(0.5, 1.0)
        return Start(memory={"place": place}, info={"place": place})

    def way(self, numbers: Any) -> Any:
        """(n, 1) [m] to the place."""
        return numbers["place"] - numbers["position/cart"][:, :1]

    def observe(self, numbers: Any) -> Mapping[str, Any]:
        """The way."""
        return {"way": self.way(numbers)}

    def reward(self, numbers: Any) -> Mapping[str, Any]:
        """Minus the distance."""
        return {"distance": -np.abs(self.way(numbers))[:, 0]}

    def succeeded(self, numbers: Any) -> Any:
        """At the place."""
        return np.abs(self.way(numbers))[:, 0] < 0.01


def run(n: int = 2, **mistake: Any) -> None:
    """A reset and two steps of a cart with other attributes or methods."""
    episodes = Episodes(type("Wrong", (Cart,), mistake)(), n, 1)
    episodes.reset()
    episodes.look(remember=None)
    for _ in range(2):
        episodes.step(np.zeros((n, 1)))
        episodes.look(remember=np.ones(n, dtype=bool))


def with_actions(cart: Cart, actions: Any) -> None:
    Cart.__init__(cart)
    cart.actions = actions


X = np.zeros(2)
MISTAKES = {
    "Wrong: `terms` is not set": {"terms": property(lambda self: self.nothing)},
    "Wrong.terms: wanted names, each once, got 'distance'": {"terms": ("distance")},
    "Wrong.observation: wanted a tuple of Group, got Group": {"observation": Cart.observation[0]},
    "Wrong.observation: wanted names, each once, got ['way', 'way']": {
        "observation": Cart.observation[:1] * 2
    },
    "Wrong.actions: wanted one at least": {"__init__": lambda self: with_actions(self, {})},
    "Wrong.actions: 'hand' has 1 numbers, got scales of shape (2,)": {
        "__init__": lambda self: with_actions(self, {"hand": [0.5, 0.5]})
    },
    "action 'hand': its scale of 2.0 is larger than [1.], that of its channel": {
        "__init__": lambda self: with_actions(self, {"hand": 2.0})
    },
    "Wrong.units: 'hand' has 1 numbers, got 2 units": {"units": {"hand": ["m/s", "m/s"]}},
    "Wrong.units: action 'hend' does not exist; there are: hand": {"units": {"hend": "m/s"}},
    "Wrong.rate: wanted up to 500 Hz, got 0.0": {"rate": 0.0},
    # 1 / (30 Hz x 2 ms) = 16.67 ticks; 1 / (17 x 2 ms) and 1 / (16 x 2 ms)
    "Wrong.rate: wanted a whole number of control ticks of 2 ms a step, got 30 Hz (16.6667 ticks); "
    "the nearest rates are 29.4118 and 31.25 Hz": {"rate": 30},
    "Wrong.rate: wanted a whole number of control ticks of 2 ms a step, got 400 Hz (1.25 ticks); "
    "the nearest rates are 250 and 500 Hz": {"rate": 400.0},
    "Wrong.memory: 'place' wants a whole number, got (1,)": {"memory": {"place": (1,)}},
    "Wrong.memory: 'time' is a quantity": {"memory": {"place": 1, "time": 1}},
    "Wrong.parameters: entry of the memory 'mass' does not exist; there are: place": {
        "parameters": ("mass",)
    },
    "Wrong has a goal of 2, but no goals()": {"goal": 2},
    "Wrong.start: wanted a Start, got dict {}": {"start": lambda self, g: {}},
    "Wrong.start: entry of the memory 'plase' does not exist; there are: place": {
        "start": lambda self, g: Start(memory={"plase": 1.0})
    },
    "Wrong.start: memory 'place': wanted numbers of shape (1,), got float64 of shape (3,)": {
        "start": lambda self, g: Start(memory={"place": np.zeros(3)})
    },
    "Wrong.start: memory 'place': wanted finite numbers, got nan at ()": {
        "start": lambda self, g: Start(memory={"place": np.nan})
    },
    "Wrong.start: qpos: wanted numbers of shape (1,), got float64 of shape (3,)": {
        "start": lambda self, g: Start(np.zeros(3))
    },
    "Wrong.start: 'time' is in info already": {"start": lambda self, g: Start(info={"time": 0.0})},
    "numbers: quantity or entry of the memory 'plase' does not exist; there are: ": {
        "observe": lambda self, numbers: {"way": numbers["plase"]}
    },
    "Wrong.observe: group of the observation 'wai' does not exist; there are: way, velocity": {
        "observe": lambda self, numbers: {"wai": self.way(numbers)}
    },
    "Wrong.observe: group 'way' is missing; there are: position/cart, velocity/cart, place": {
        "observe": lambda self, numbers: {}
    },
    "Wrong.observe: 'way': wanted numbers of shape (2, 1), got float64 of shape (2,)": {
        "observe": lambda self, numbers: {"way": self.way(numbers)[:, 0]}
    },
    "Wrong.observe: 'way': wanted finite numbers, got nan at (0, 0)": {
        "observe": lambda self, numbers: {"way": np.full((2, 1), np.nan)}
    },
    "Wrong.observe writes to what it is given (": {
        "observe": lambda self, numbers: {"way": numbers["position/cart"].sort()}
    },
    "Wrong.reward writes to what it is given (": {
        "reward": lambda self, numbers: {"distance": numbers["place"].sort()}
    },
    "wanted a copy, numbers[NAME].copy(), or in `remember` numbers.memory[NAME]": {
        "remember": lambda self, numbers: numbers["place"].fill(1.0)
    },
    "Wrong.reward: term 'bonus' does not exist; there are: distance": {
        "reward": lambda self, numbers: {"distance": X, "bonus": X}
    },
    "Wrong.reward: term 'effort' is missing": {"terms": ("distance", "effort")},
    "Wrong.reward: term 'distance': wanted numbers of shape (2,), got float64 of shape (2, 1)": {
        "reward": lambda self, numbers: {"distance": self.way(numbers)}
    },
    "Wrong.reward: wanted a dictionary, got float64 of shape (2,)": {
        "reward": lambda self, numbers: X
    },
    "Wrong.reward: term 'distance': wanted numbers of shape (2,), got float -0.01": {
        "reward": lambda self, numbers: {"distance": -0.01}
    },
    "Wrong.reward: term 'distance': wanted finite numbers, got inf at (1,)": {
        "reward": lambda self, numbers: {"distance": np.array([0.0, np.inf])}
    },
    "Wrong.succeeded: wanted bool of shape (2,), got bool of shape (2, 1)": {
        "succeeded": lambda self, numbers: self.way(numbers) < 0.01
    },
    "Wrong.ended: wanted bool of shape (2,), got float64 of shape (2,)": {
        "ended": lambda self, numbers: X
    },
    "Wrong.tell: 'cost' is in info already": {"tell": lambda self, numbers: {"cost": X}},
    "Wrong.tell: 'way': wanted numbers of shape (2,), got float64 of shape (2, 1)": {
        "tell": lambda self, numbers: {"way": self.way(numbers)}
    },
    "Wrong.remember: entry of the memory 'plase' does not exist; there are: place": {
        "remember": lambda self, numbers: numbers.memory.update(plase=X)
    },
    "numbers.hold counts in the memory: it wants an entry 'held' of one number, there are place": {
        "remember": lambda self, numbers: numbers.hold(X > 0.0, 1.0)
    },
    "Wrong.remember: memory 'place': wanted numbers of shape (2, 1), got float64 of shape (2,)": {
        "remember": lambda self, numbers: numbers.memory.update(place=X)
    },
    "Wrong.command: channel 'hnad' does not exist; there are: hand": {
        "command": lambda self, action, numbers: {"hnad": action["hand"]}
    },
    "Wrong.command: 'hand': wanted numbers of shape (2, 1), got float64 of shape (2,)": {
        "command": lambda self, action, numbers: {"hand": action["hand"][:, 0]}
    },
    "Wrong.command: 'hand': wanted numbers of shape (2, 1), got float64 of shape (1, 1)": {
        "command": lambda self, action, numbers: {"hand": action["hand"][:1]}
    },
}


def test_an_environment_without_a_mistake_runs() -> None:
    run()
    run(tell=lambda self, numbers: {"way": self.way(numbers)[:, 0]})
    run(rate=29.4118)  # 17 ticks, as the error says it


@pytest.mark.parametrize("text", MISTAKES)
def test_a_mistake_is_told_in_one_sentence(text: str) -> None:
    with pytest.raises(hurcules.Error, match=re.escape(text)):
        run(**MISTAKES[text])


LATE = {
    "Wrong.reward: term 'bonus' does not exist": ("reward", {"distance": X, "bonus": X}),
    "Wrong.reward: term 'distance': wanted finite": ("reward", {"distance": X + np.nan}),
    "Wrong.observe: 'way': wanted finite": ("observe", {"way": X[:, None] + np.nan}),
    "Wrong.tell: name 'more' does not exist": ("tell", {"more": X}),
}


@pytest.mark.parametrize("text", LATE)
def test_what_goes_wrong_steps_later_is_told_too(text: str) -> None:
    method, wrong = LATE[text]
    calls = iter(range(9))

    def answer(self: Cart, numbers: Any) -> Any:
        right = {} if method == "tell" else getattr(Cart, method)(self, numbers)
        return right if next(calls) < 2 else wrong

    with pytest.raises(hurcules.Error, match=text):
        run(**{method: answer})


def test_what_no_name_leads_to_is_not_registered() -> None:
    class Inner(Cart):
        """Found by no name."""

    for wrong in (Inner, int, "no_class", "module:"):
        with pytest.raises(
            hurcules.Error, match="wanted a class of Environment at the top of a mo"
        ):
            hurcules_envs.register("Own/Cart-v0", wrong, max_episode_steps=10)  # type: ignore


def test_a_class_is_registered_as_its_text_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(gymnasium, "registry", registry := dict(gymnasium.registry))
    monkeypatch.setattr("gymnasium.envs.registration.registry", registry)
    hurcules_envs.register("Own/Class-v0", Cart, max_episode_steps=10)
    assert gymnasium.spec("Own/Class-v0").kwargs == {"environment": f"{__name__}:Cart"}
    with gymnasium.make("Own/Class-v0") as env:
        assert isinstance(env.unwrapped.environment, Cart)  # type: ignore[attr-defined]


CHANGES = {
    "rate": 10.0,
    "actions": {"hand": 0.5},
    "observation": Cart.observation[:1],
    "terms": ("distance", "effort"),
}


@pytest.mark.parametrize("name", CHANGES)
def test_what_is_read_once_is_not_changed_in_silence(name: str) -> None:
    env = SingleEnv(f"{__name__}:Cart")
    env.reset(seed=0)
    setattr(env.environment, name, CHANGES[name])
    with pytest.raises(hurcules.Error, match=f"Cart.{name} is read once, when the environment is"):
        env.reset()


def test_an_action_that_is_changed_in_place_is_told_too() -> None:
    env = SingleEnv(f"{__name__}:Cart")
    env.reset(seed=0)
    env.environment.actions["hand"] = 0.5  # type: ignore[index]
    with pytest.raises(hurcules.Error, match=r"actions is read once.*\{'hand': 1.0\} then"):
        env.reset()


class Fast(Cart):
    """With fidelities and rates, as docs/environments.md says."""

    fidelities = ("exact", "fast", "kinematic")

    def __init__(self, fidelity: str = "exact", rate: float = 20.0) -> None:
        super().__init__()
        self.rate = rate
        model = mujoco.MjModel.from_xml_string(CART)
        dt = model.opt.timestep = tick_of(fidelity, rate, self.fidelities)
        robot = hurcules.Robot(model, ["rail"])
        hand = hurcules.PositionTask("hand", robot, "cart", axes=[[1, 0, 0]])
        channels = {"hand": hurcules.Twist(hand, 1.0)}
        controller = hurcules.WholeBodyController(robot, [hand], channels, dt=dt)
        physics = fidelity != "kinematic"
        self.simulation = hurcules.Simulation(
            model=model, controller=controller, record=False, physics=physics
        )


@pytest.mark.parametrize("rate", [20.0, 50.0])
@pytest.mark.parametrize(
    ("fidelity", "most"), [("exact", 1e-3), ("fast", 4e-3), ("kinematic", 50e-3)]
)
def test_an_environment_of_ones_own_has_fidelities_and_rates(
    fidelity: str, most: float, rate: float
) -> None:
    env = SingleEnv(f"{__name__}:Fast", fidelity=fidelity, rate=rate)
    env.reset(seed=0)
    for _ in range(10):
        env.step(np.ones(1, np.float32))
    longest = min(most, 1.0 / rate)
    assert 0.7 * longest < env.environment.simulation.dt <= longest + 1e-12
    assert env.simulation.time == pytest.approx(10 / rate)
    assert env.data.body("cart").xpos[0] == pytest.approx(10 / rate, abs=0.03)  # 1 m/s
    with pytest.raises(
        hurcules.Error, match="fidelity 'slow' does not exist; there are: exact, fa"
    ):
        SingleEnv(f"{__name__}:Fast", fidelity="slow")


@pytest.mark.parametrize(("fidelity", "told"), [("fast", False), ("kinematic", True)])
def test_things_that_nothing_moves_without_physics_are_told(
    monkeypatch: pytest.MonkeyPatch, fidelity: str, told: bool
) -> None:
    box = '<body name="box" pos="1 0 0"><freejoint/><geom size="0.1"/></body></worldbody>'
    monkeypatch.setattr(f"{__name__}.CART", CART.replace("</worldbody>", box))
    text = r'Fast: without physics nothing moves box; .* fidelities = \("exact", "fast"\)'
    with pytest.warns(UserWarning, match=text) if told else nullcontext():
        SingleEnv(f"{__name__}:Fast", fidelity=fidelity)


class Told(Cart):
    """What another episode takes over: a curriculum."""

    far = 0.5

    def start(self, generator: np.random.Generator) -> Start:
        """As far as is told."""
        return Start(memory={"place": self.far}, info={"place": self.far})


def test_a_curriculum_changes_what_start_reads() -> None:
    env = SingleEnv(f"{__name__}:Told")
    assert env.reset()[1]["place"] == 0.5
    env.environment.far = 0.9  # type: ignore[attr-defined]
    assert env.reset()[1]["place"] == 0.9


class Over(Cart):
    """Ends where it begins."""

    def failed(self, numbers: Any) -> Any:
        """At once."""
        return np.ones(len(numbers.action), dtype=bool)


def test_a_step_after_the_end_is_told() -> None:
    env, hold = SingleEnv(f"{__name__}:Over"), np.zeros(1, np.float32)
    env.reset(seed=0)
    assert env.step(hold)[2]  # in silence, warnings are errors here
    with pytest.warns(UserWarning, match=r"step\(\) after the episode terminated: reset\(\)"):
        env.step(hold)
    env.reset()
    env.step(hold)


def test_names_and_period_of_a_step_can_be_read_and_not_written() -> None:
    for env in (SingleEnv(f"{__name__}:Cart"), NativeVectorEnv(f"{__name__}:Cart", 2)):
        assert env.dt == pytest.approx(0.05)  # 20 Hz
        names = ["way", "velocity/cart_0", "velocity/cart_1", "velocity/cart_2"]
        assert env.observation_names == names
        for name in ("dt", "observation_names"):
            with pytest.raises(AttributeError):
                setattr(env, name, 1)


def test_check_env_of_gymnasium_has_nothing_to_say() -> None:
    check_env(SingleEnv(f"{__name__}:Cart"), skip_render_check=True)


def test_a_picture_looks_at_the_robot_that_is_there() -> None:
    cart = Cart()
    camera = cart.camera()
    assert isinstance(camera, mujoco.MjvCamera)
    model = cart.simulation.model
    np.testing.assert_allclose(camera.lookat, model.stat.center)
    assert camera.distance < 2.0 * model.stat.extent  # it was where Hurcules stands, 3.5 m off
    filmed = CART.replace("<worldbody>", '<worldbody><camera name="film"/>')
    cart.simulation = hurcules.Simulation(
        model=(model := mujoco.MjModel.from_xml_string(filmed)),
        controller=hurcules.WholeBodyController(
            robot := hurcules.Robot(model), [hurcules.PostureTask("posture", robot)]
        ),
    )
    assert cart.camera() == "film"


class Loaded(Cart):
    """A keyword that `gymnasium.make` would take for one of its own."""

    def __init__(self, mass: float = 1.0) -> None:
        super().__init__()


def test_a_keyword_that_would_never_come_is_refused() -> None:
    text = "Loaded: the keyword 'mass' is taken, by what every environment has: call it otherwise"
    with pytest.raises(hurcules.Error, match=re.escape(text)):
        make_environment(f"{__name__}:Loaded", {})


OWN = "own_rail:Own/Rail-v0"


def own_module(folder: Path) -> None:
    """A user's file that registers the cart."""
    (folder / "own_rail.py").write_text(
        "import hurcules_envs\n"
        f"import sys; sys.path.append({str(Path(__file__).parent)!r})\n"
        "from test_env_author import Cart as Rail\n"
        "hurcules_envs.register('Own/Rail-v0', 'own_rail:Rail', max_episode_steps=100)\n"
    )


def command(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """The console script, which has not its folder on Python's path."""
    start = "import sys; sys.path.remove(''); from hurcules_command import main; sys.exit(main())"
    line = [sys.executable, "-c", start, *words]
    return subprocess.run(line, cwd=folder, capture_output=True, text=True, check=False)


def test_the_module_of_an_id_is_imported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    own_module(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    judged = evaluate(lambda seen: np.clip(5.0 * seen[:, :1], -1.0, 1.0), OWN, 3)
    assert (judged.episodes, judged.success) == (3, 1.0)


def test_the_expert_of_an_environment_of_ones_own_is_cloned_as_in_the_example(
    tmp_path: Path, root: Path
) -> None:
    own_module(tmp_path)
    with (tmp_path / "own_rail.py").open("a") as file:
        file.write("Rail.expert = lambda self, numbers: self.way(numbers).clip(-1.0, 1.0)\n")
    example = root / "python" / "examples" / "12_behaviour_cloning.py"
    few = ["--episodes", "2", "--epochs", "1", "--judge", "2", "--out", str(tmp_path)]
    done = subprocess.run(
        [sys.executable, example, OWN, *few],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": os.pathsep.join([str(tmp_path), *sys.path])},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert "2 demonstrations, 2 succeeded" in done.stdout
    assert (tmp_path / "Rail-v0.onnx").exists()


class Laden(Drive):
    """Drive with something heavy on the torso."""

    parameters = ("payload",)

    def __init__(self, most: float = 100.0, **options: Any) -> None:
        super().__init__(**options)
        self.memory = {**self.memory, "payload": 1}
        self._most = most

    def start(self, generator: np.random.Generator) -> Start:
        """As Drive starts, with a load."""
        start, payload = super().start(generator), generator.uniform(0.0, self._most)
        memory = {**start.memory, "payload": payload}
        return replace(start, memory=memory, info={"payload": payload})

    def configure(self, model: mujoco.MjModel, values: Mapping[str, Any]) -> None:
        """Adds the load."""
        model.body("torso").mass += values["payload"]
        mujoco.mj_setConst(model, mujoco.MjData(model))


@pytest.mark.parametrize("mass", [1.0, 1.2])
def test_a_class_that_passes_keywords_on_adds_to_the_model_of_each_episode(mass: float) -> None:
    env = SingleEnv(f"{__name__}:Laden", most=50.0, fidelity="fast", mass=mass)
    nominal = mass * float(env.environment.simulation.model.body("torso").mass[0])
    for _ in range(2):  # what an episode adds is taken back by the next
        _, info = env.reset()
        assert 0.0 < info["payload"] < 50.0
        loaded = nominal + mass * info["payload"]
        assert env.model.body("torso").mass[0] == pytest.approx(loaded)
    with pytest.raises(hurcules.Error, match="there are: most, fidelity, terrain"):
        SingleEnv(f"{__name__}:Laden", fidelty="fast")


def test_commands_take_an_environment_of_ones_own(tmp_path: Path) -> None:
    own_module(tmp_path)
    nodes = (Node("Gemm", ("observation", "weight"), ("action",), {"transB": 1}),)
    weights = {"weight": np.array([[5.0, 0.0, 0.0, 0.0]])}
    graph = Graph(nodes, weights, {"observation": 4}, {"action": 1}, {"environment": OWN})
    write(tmp_path / "policy.onnx", graph)
    ran = command(tmp_path, "evaluate", "policy.onnx", "--episodes", "3")
    assert "success        100%" in ran.stdout, ran.stderr
    for words, told in (
        ("own_rail:Own/Road-v0", "'own_rail:Own/Road-v0' does not exist; there are: Rail-v0"),
        ("own_road:Own/Rail-v0", "No module named 'own_road'; wanted module:Namespace/Name-v0"),
        ("Road-v0", "'Hurcules/Road-v0' does not exist; there are: Carry-v0, "),
        ("Own/Rail-v0", "; one of your own is MODULE:Own/Rail-v0, with the module that registers"),
    ):
        assert told in command(tmp_path, "record", words).stderr
    told = command(tmp_path, "evaluate", "policy.onnx", "--fidelity", "fast").stderr
    assert "option 'fidelity' does not exist" in told
