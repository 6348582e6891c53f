"""Policies as ONNX files: written, read, judged, run. PyTorch is not needed.

Strategy: small networks of known weights are written and read back; what ships is run in its
environment. Where the package onnx is installed, it checks the files and computes the same.
Not tested: that training leads anywhere (docs/environments.md has the figures).
"""

import json
import shlex
import signal
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import gymnasium
import numpy as np
import pytest

import hurcules
import hurcules_envs
from hurcules.cli import main
from hurcules.plugins import PolicyOptions
from hurcules.shares import wilson
from hurcules_envs.endings import Ending
from hurcules_envs.evaluation import evaluate
from hurcules_envs.onnx_file import Graph, Node, read, write
from hurcules_envs.policy import Policy, shipped
from hurcules_envs.running import _judging

REACH = {"environment": "Hurcules/Reach-v0", "options": '{"fidelity": "kinematic"}'}
GOAL = {"desired_goal": 6, "achieved_goal": 6}


def linear(path: Path, gain: float = 3.0, inputs=GOAL, metadata=REACH, kind: str = "Tanh") -> Path:
    """A policy that goes straight to the goal: tanh(gain (desired - achieved))."""
    nodes = (
        Node("Sub", ("desired_goal", "achieved_goal"), ("way",)),
        Node("Gemm", ("way", "weight", "bias"), ("sum",), {"transB": 1, "alpha": 0.5}),
        Node(kind, ("sum",), ("action",)),
    )
    weights = {"weight": 2.0 * gain * np.eye(6), "bias": np.zeros(6)}
    write(path, Graph(nodes, weights, inputs, {"action": 6}, metadata))
    return path


def test_what_is_written_is_read(tmp_path: Path) -> None:
    graph = read(linear(tmp_path / "a.onnx"))
    assert [node.kind for node in graph.nodes] == ["Sub", "Gemm", "Tanh"]
    assert graph.nodes[1].attributes == {"transB": 1, "alpha": 0.5}
    assert (graph.inputs, graph.outputs, graph.metadata) == (GOAL, {"action": 6}, REACH)
    assert np.array_equal(graph.weights["weight"], 6.0 * np.eye(6, dtype=np.float32))


def test_a_policy_computes_its_network(tmp_path: Path) -> None:
    policy = Policy(linear(tmp_path / "a.onnx"))
    generator = np.random.default_rng(0)
    seen = {name: generator.normal(size=(5, 6)).astype(np.float32) for name in GOAL}
    way = seen["desired_goal"] - seen["achieved_goal"]
    assert np.allclose(policy(seen), np.tanh(3.0 * way), atol=1e-6)
    assert policy(seen).dtype == np.float32


def test_other_programs_read_the_files(tmp_path: Path) -> None:
    onnx = pytest.importorskip("onnx", reason="pip install onnx")
    from onnx.reference import ReferenceEvaluator

    seen = {name: np.ones((2, size), np.float32) for name, size in GOAL.items()}
    for path in (linear(tmp_path / "a.onnx"), shipped()["Hurcules/Reach-v0"]):
        onnx.checker.check_model(onnx.load(path), full_check=True)
        theirs = ReferenceEvaluator(str(path)).run(None, seen)[0]
        assert np.allclose(Policy(path)(seen), theirs, atol=1e-6)


def test_a_policy_acts_in_one_line_and_is_judged(tmp_path: Path) -> None:
    policy = Policy(linear(tmp_path / "a.onnx", gain=8.0))  # 5 /s is too slow for some goals
    result = evaluate(policy, "Hurcules/Reach-v0", 8, fidelity="kinematic")
    assert (result.episodes, result.success, result.self_contacts) == (8, 1.0, 0.0)
    assert result.mean_cost == 0.0
    assert wilson(8, 8) == pytest.approx((0.676, 1.0), abs=1e-3)  # Wilson (1927)


@pytest.mark.parametrize("episodes", [0, -1, 2.5])
def test_how_many_episodes_are_judged_is_a_whole_number(episodes: Any) -> None:
    with pytest.raises(
        hurcules.Error, match=f"episodes: wanted a whole number >= 1, got {episodes}"
    ):
        evaluate(lambda seen: seen, "Reach-v0", episodes, fidelity="kinematic")


def test_endings_are_counted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    ahead = np.tile([[0.0] * 11, [1.0, 0.0, 0.0] * 2 + [0.0] * 5], (2, 1))  # holds, goes too far
    result = evaluate(lambda _: ahead, "Stretch-v1", 4, fidelity="kinematic")
    assert result.endings == {"Missed": 2, "TimeLimit": 2}
    assert (result.failures, result.falls) == (0.5, 0.0)
    weights = {"weight": np.zeros((28, 11)), "bias": ahead[1]}
    nodes = (Node("Gemm", ("observation", "weight", "bias"), ("action",)),)
    metadata = {"environment": "Hurcules/Stretch-v1"}
    write(tmp_path / "a.onnx", Graph(nodes, weights, {"observation": 28}, {"action": 11}, metadata))
    words = [str(tmp_path / "a.onnx"), "--fidelity", "kinematic", "--out", str(tmp_path)]
    assert main(["run", "--policy", *words, "--no-video"]) == 1
    said = " ".join(capsys.readouterr().out.split())
    assert "failed, " in said and "ending missed return -" in said
    assert f"hurcules evaluate {tmp_path / 'a.onnx'}" in said
    assert main(["evaluate", *words, "--episodes", "2"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "success 0% (0% to 66%) endings 2 missed return -" in said
    figures = json.loads((tmp_path / "evaluation.json").read_text())
    assert figures["endings"] == {"Missed": 2}


def test_a_single_environment_whose_limit_is_a_wrapper_has_the_vectors_ending() -> None:
    options = {"fidelity": "kinematic", "max_episode_steps": 2}
    env = gymnasium.make("Hurcules/Reach-v0", **options)
    vector = gymnasium.make_vec("Hurcules/Reach-v0", num_envs=1, **options)
    for one in (env, vector):
        one.reset(seed=0)
    for _ in range(2):
        *_, truncated, info = env.step(np.zeros(6, np.float32))
        wanted = vector.step(np.zeros((1, 6), np.float32))[4]["ending"][0]
        assert Ending.of(info, truncated) == wanted
    assert truncated and Ending.of(info, truncated).text == "time limit"
    assert Ending.of({"ending": 4}, True) == Ending.Fell


@pytest.mark.parametrize("info", [{}, {"ending": 99}, {"ending": 4.5}, {"ending": np.zeros(2)}])
def test_an_ending_that_is_none_is_told(info: dict[str, Any]) -> None:
    with pytest.raises(hurcules.Error, match="wanted 'ending', a number from 0 to 8, as a single"):
        Ending.of(info, True)


def test_the_command_that_judges_has_the_setting_of_the_episode(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "my own").mkdir()
    path = str(linear(tmp_path / "my own" / "a.onnx", 8.0))
    words = [path, "Reach-v0", "--fidelity", "kinematic", "--robot", "manipulation"]
    assert main(["run", "--policy", *words, "--no-video", "--out", str(tmp_path / "out")]) < 2
    assert f"how often it succeeds: hurcules evaluate {shlex.join(words)}\n" in (
        capsys.readouterr().out
    )
    files = PolicyOptions("a.onnx", robot="two arms.xml", frames=("left", "right"))
    wanted = "hurcules evaluate a.onnx --robot 'two arms.xml' --frame left --frame right"
    assert _judging(files) == wanted


@pytest.mark.parametrize("name", sorted(shipped()))
def test_what_ships_solves_its_environment(name: str) -> None:
    policy = Policy(name.split("/")[1])
    assert name.removesuffix("-terrain") == policy.environment
    assert {"algorithm", "steps", "seed", "action_names"} <= set(policy.metadata)
    episodes = 3 if "Lift" in name or "terrain" in name else 20  # which take longest
    assert evaluate(policy, policy.environment, episodes, **policy.options).success >= 0.9


@pytest.mark.parametrize("terrain", ["slope", "ramps", "step_field", "rough_road"])
def test_the_policy_of_terrain_drives_grounds_that_it_has_not_learnt_on(terrain: str) -> None:
    policy = Policy("Drive-v0-terrain")
    options = policy.options | {"terrain": terrain, "terrain_seed": 14, "fidelity": "fast"}
    assert evaluate(policy, policy.environment, 3, **options).success == 1.0


def test_the_command_line_judges_a_file(tmp_path: Path) -> None:
    words = ["evaluate", str(linear(tmp_path / "a.onnx", 8.0)), "--fidelity", "kinematic"]
    assert main([*words, "--episodes", "4", "--out", str(tmp_path / "judged")]) == 0
    figures = json.loads((tmp_path / "judged" / "evaluation.json").read_text())
    assert figures["success"] == 1.0
    # it took the place of that of the training
    more = ["--episodes", "2", "--robot", "manipulation", "--out", str(tmp_path / "judged")]
    assert main([*words, *more]) == 0
    assert json.loads((tmp_path / "judged" / "evaluation.json").read_text()) == figures
    other = json.loads((tmp_path / "judged" / "evaluation-2.json").read_text())
    assert other["options"] == {"fidelity": "kinematic", "robot": "manipulation"}


def test_the_command_line_judges_with_what_differs_between_episodes(tmp_path: Path) -> None:
    words = ["evaluate", str(linear(tmp_path / "a.onnx", 8.0)), "--fidelity", "kinematic"]
    words += ["--episodes", "4", "--out", str(tmp_path)]
    given = ["--vary", "action_delay=2,5", "--vary", "observation_noise=0.01"]
    given += ["--set", "safe=false"]
    assert main([*words, *given]) == 0
    figures = json.loads((tmp_path / "evaluation.json").read_text())
    ranges = {"action_delay": [2.0, 5.0], "observation_noise": [0.01, 0.01]}
    assert figures["options"] == {"fidelity": "kinematic", "safe": False} | ranges
    options = {"fidelity": "kinematic", "action_delay": (2, 5), "observation_noise": 0.01}
    options["safe"] = False
    same = evaluate(tmp_path / "a.onnx", "Reach-v0", 4, **options)
    assert figures["mean_return"] == same.mean_return


def test_the_command_line_runs_an_episode(tmp_path: Path) -> None:
    words = ["run", "--policy", "Reach-v0", "--seed", "3", "--fidelity", "kinematic", "--no-video"]
    assert main([*words, "--out", str(tmp_path)]) == 0
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert (summary["success"], summary["steps"], summary["seed"]) == (True, 100, 3)
    assert (summary["ending"], summary["cost"]) == ("TimeLimit", 0.0)
    terms = [value for key, value in summary.items() if key.startswith("reward_")]
    assert sum(terms) == pytest.approx(summary["return"])
    with np.load(tmp_path / "episode.npz") as episode:
        assert (len(episode["qpos"]), len(episode["actions"])) == (101, 100)
        env = gymnasium.make("Hurcules/Reach-v0", fidelity="kinematic")
        env.reset(seed=3)
        rewards = [env.step(action.astype(np.float32))[1] for action in episode["actions"]]
        assert rewards == episode["rewards"].tolist()  # actions alone give the same bits


def test_an_episode_that_was_interrupted_is_no_failure(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    def acts(*_: object) -> np.ndarray:
        signal.raise_signal(signal.SIGINT)
        return np.zeros(6, np.float32)

    monkeypatch.setattr(Policy, "one", acts)
    words = ["run", "--policy", "Reach-v0", "--fidelity", "kinematic", "--no-video"]
    assert main([*words, "--out", str(tmp_path)]) == 130
    said = capsys.readouterr().out
    assert "\ninterrupted, 0.1 s, 1 steps\n" in said and "ending" not in said


def test_an_episode_lasts_as_long_at_the_rate_of_its_policy(tmp_path: Path) -> None:
    metadata = REACH | {"options": '{"rate": 10}'}
    policy = linear(tmp_path / "a.onnx", metadata=metadata)
    words = ["run", "--policy", str(policy), "--fidelity", "kinematic", "--no-video"]
    assert main([*words, "--out", str(tmp_path)]) in (0, 1)
    assert json.loads((tmp_path / "summary.json").read_text())["steps"] == 50  # 5 s


def test_the_command_line_films_an_episode_and_says_that_it_failed(tmp_path: Path) -> None:
    pytest.importorskip("imageio_ffmpeg", reason="pip install 'hurcules[report]'")
    hurcules_envs.register("Own/Short-v0", "hurcules_envs.reach:Reach", 5)
    metadata = REACH | {"environment": "Own/Short-v0"}
    policy = linear(tmp_path / "a.onnx", metadata=metadata)
    words = ["run", "--policy", str(policy), "--fidelity", "kinematic", "--out", str(tmp_path)]
    assert main(words) == 1  # a quarter of a second is too short
    assert (tmp_path / "video.mp4").stat().st_size > 5_000


def test_bad_files_get_one_clear_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "onnxruntime", None)  # as if it were not installed
    whole = linear(tmp_path / "a.onnx").read_bytes()
    cases = {
        "text.onnx": (b"no network at all", "wanted an ONNX file"),
        "empty.onnx": (b"", "wanted an ONNX file"),
        "cut.onnx": (whole[:100], "wanted an ONNX file"),
    }
    for name, (content, text) in cases.items():
        (tmp_path / name).write_bytes(content)
        with pytest.raises(hurcules.Error, match=text):
            Policy(tmp_path / name)
    for name in ("none.onnx", "none.zip"):
        with pytest.raises(hurcules.Error, match=r"no such file"):
            Policy(tmp_path / name)
    with pytest.raises(hurcules.Error, match=r"no policy\.onnx lies there"):
        Policy(tmp_path)
    (tmp_path / "policy.zip").touch()
    with pytest.raises(hurcules.Error, match=r"of Stable-Baselines3, its policy\.onnx is wanted"):
        Policy(tmp_path / "policy.zip")
    with pytest.raises(hurcules.Error, match="Softmax want onnxruntime"):
        Policy(linear(tmp_path / "b.onnx", kind="Softmax"))


def test_policies_of_others_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def complaint(*words: str) -> str:
        assert main([*words, "--out", str(tmp_path / "out")]) == 2
        return capsys.readouterr().err

    reach = str(linear(tmp_path / "a.onnx"))
    assert "wanted a policy of Hurcules/Drive-v0, got one of Hurcules/Reach-v0" in complaint(
        "run", "--policy", reach, "Drive-v0"
    )
    bare = str(linear(tmp_path / "b.onnx", metadata={}))
    assert "does not say its environment" in complaint("evaluate", bare)
    assert "wanted the inputs achieved_goal (4), desired_goal (4), observation (15)" in complaint(
        "evaluate", bare, "Drive-v0", "--fidelity", "kinematic", "--episodes", "1"
    )
    for file in (bare, reach):  # of the second it said that it is no policy of Fly-v0
        assert "'Hurcules/Fly-v0' does not exist" in complaint("run", "--policy", file, "Fly-v0")
    assert "Stretch-v0 has no native vector" in complaint("run", "--policy", bare, "Stretch-v0")
    other = linear(tmp_path / "c.onnx", metadata=REACH | {"options": '{"colour": "red"}'})
    said = complaint("run", "--policy", str(other), "--no-video")
    assert "option 'colour' does not exist" in said
    assert said.endswith(", push, payload\n")  # Gymnasium's words about its creator came after it
    assert "for policies" in complaint("run", "stretch", "--fidelity", "fast")
    assert "not with --policy" in complaint("run", "--policy", reach, "--seconds", "3")


def test_weights_beside_the_file_are_read(tmp_path: Path) -> None:
    """PyTorch writes large ones so: it was called a broken file."""
    onnx = pytest.importorskip("onnx", reason="pip install onnx")
    path = linear(tmp_path / "a.onnx")
    seen = {name: np.random.default_rng(0).normal(size=(5, 6)) for name in GOAL}
    wanted = Policy(path)(seen)
    onnx.save_model(
        onnx.load(path), path, save_as_external_data=True, location="a.data", size_threshold=0
    )
    assert np.array_equal(Policy(path)(seen), wanted)
    (tmp_path / "a.data").unlink()
    with pytest.raises(hurcules.Error, match=r"a\.data: cannot be read: No such file"):
        Policy(path)


def test_the_exponential_linear_unit_is_known(tmp_path: Path) -> None:
    policy = Policy(linear(tmp_path / "a.onnx", gain=1.0, kind="Elu"))
    way = np.linspace(-0.9, 0.9, 6)
    seen = {"achieved_goal": np.zeros(6), "desired_goal": way}
    assert np.allclose(policy.one(seen), np.where(way > 0, way, np.exp(way) - 1), atol=1e-6)


@pytest.mark.parametrize("name", ["obs", "observation"])
@pytest.mark.parametrize("said", [True, False])
def test_a_policy_of_one_array_sees_the_way_to_the_goal(
    tmp_path: Path, name: str, said: bool
) -> None:
    """Libraries without goals train with flat=True; what they wrote did not fit the commands."""
    gain = np.random.default_rng(0).normal(0.0, 0.01, (24, 6))
    gain[18:] += 3.0 * np.eye(6)
    graph = Graph(
        (Node("MatMul", (name, "w"), ("action",)),), {"w": gain},
        {name: 24 if said or name == "observation" else 0}, {"action": 6},
    )  # fmt: skip
    write(tmp_path / "flat.onnx", graph)
    policy = Policy(tmp_path / "flat.onnx")
    seen, whole = [
        gymnasium.make("Hurcules/Reach-v0", fidelity="kinematic", flat=one).reset(seed=0)[0]
        for one in (False, True)
    ]
    assert np.allclose(policy.one(seen), policy.one(whole), atol=1e-5)
    results = [
        evaluate(policy, "Reach-v0", 2, fidelity="kinematic", **flat)
        for flat in ({}, {"flat": True})
    ]
    assert results[0].mean_return == pytest.approx(results[1].mean_return, abs=1e-3)
    with pytest.raises(hurcules.Error, match="does not fit Hurcules/Drive-v0"):
        evaluate(policy, "Drive-v0", 1, fidelity="kinematic")


@pytest.mark.parametrize("raw", [True, False])
def test_weights_of_other_types_are_read(tmp_path: Path, raw: bool) -> None:
    """A network of half the precision was called a broken file."""
    onnx = pytest.importorskip("onnx", reason="pip install onnx")
    make, path = onnx.helper, tmp_path / "half.onnx"
    half, values = onnx.TensorProto.FLOAT16, np.array([[0.5, -0.25], [0.0, 1.0]], np.float16)
    given = {"vals": values.tobytes() if raw else values, "raw": raw}
    weights = [make.make_tensor("w", half, (2, 2), **given)]
    whole = {"vals": np.array([7, -3], np.int32).tobytes() if raw else [7, -3], "raw": raw}
    weights += [make.make_tensor("n", onnx.TensorProto.INT32, (2,), **whole)]
    ports = [[make.make_tensor_value_info(name, half, ["n", 2])] for name in ("observation", "a")]
    node = make.make_node("MatMul", ["observation", "w"], ["a"])
    onnx.save(make.make_model(make.make_graph([node], "g", *ports, weights)), path)
    assert np.array_equal(read(path).weights["n"], [7, -3])
    assert np.array_equal(Policy(path).one(np.ones(2)), [0.5, 0.75])


def test_the_command_line_judges_at_another_rate(tmp_path: Path) -> None:
    path, out = linear(tmp_path / "reach.onnx"), str(tmp_path / "out")
    assert main(["evaluate", str(path), "--episodes", "1", "--rate", "50", "--out", out]) == 0
    assert json.loads((tmp_path / "out" / "evaluation.json").read_text())["options"]["rate"] == 50


def test_numbers_that_are_not_finite_are_no_action(tmp_path: Path) -> None:
    policy = Policy(linear(tmp_path / "a.onnx"))
    with pytest.raises(hurcules.Error, match="not finite"):
        policy({name: np.full((1, 6), np.nan, np.float32) for name in GOAL})


class OtherRuntime:
    """Stands for onnxruntime: computes a network that takes rows of doubles, so many at a time."""

    def __init__(self, rows: object) -> None:
        self.rows = rows

    def get_inputs(self) -> list[SimpleNamespace]:
        """What it takes."""
        kind = {"type": "tensor(double)", "shape": [self.rows, 6]}
        return [SimpleNamespace(name=name, **kind) for name in GOAL]

    def run(self, _outputs: None, fed: dict) -> list[np.ndarray]:
        """The network's answer."""
        assert all(values.dtype == np.float64 for values in fed.values())
        if isinstance(self.rows, int) and len(fed["desired_goal"]) != self.rows:
            raise RuntimeError("Got invalid dimensions\n  for input")
        return [np.tanh(3.0 * (fed["desired_goal"] - fed["achieved_goal"]))]


@pytest.mark.parametrize("rows", ["n", 1])
def test_networks_of_another_runtime_take_rows_as_they_were_exported(tmp_path, rows) -> None:
    """Exporters fix the batch at 1, unless they are told otherwise."""
    policy = Policy(linear(tmp_path / "a.onnx"))
    seen = {name: np.random.default_rng(0).normal(size=(5, 6)) for name in GOAL}
    wanted = policy(seen)
    policy._session = OtherRuntime(rows)
    assert np.allclose(policy(seen), wanted, atol=1e-6)
    policy._session = OtherRuntime(2)
    with pytest.raises(hurcules.Error, match=r"a\.onnx: Got invalid dimensions for input$"):
        policy(seen)


def test_a_file_is_judged_by_its_name(tmp_path: Path) -> None:
    path = linear(tmp_path / "a.onnx", gain=8.0)
    assert evaluate(path, "Reach-v0", 2, fidelity="kinematic").success == 1.0


def test_a_policy_says_what_it_wants_and_got(tmp_path: Path) -> None:
    """A key that lacks was a KeyError, a shape numpy's ValueError, a list a TypeError."""
    policy = Policy(linear(tmp_path / "a.onnx"))
    assert repr(policy) == (
        "Policy(Hurcules/Reach-v0: desired_goal (6), achieved_goal (6) to action (6))"
    )
    good = {"desired_goal": [0.1] * 6, "achieved_goal": np.zeros(6)}
    assert np.allclose(policy.one(good), np.tanh(0.3))
    for change, said in (
        ({"achieved_goal": np.zeros(3)}, "wanted 6 numbers in 'achieved_goal', got 3"),
        ({"achieved_goal": np.full(6, np.nan)}, "the numbers in 'achieved_goal' are not finite"),
        ({"achieved_goal": "here"}, "wanted an array of numbers in 'achieved_goal', got 'here'"),
    ):
        with pytest.raises(hurcules.Error, match=said):
            policy.one(good | change)
    with pytest.raises(hurcules.Error, match="not there: desired_goal"):
        policy.one({"achieved_goal": np.zeros(6)})
    with pytest.raises(hurcules.Error, match=r"a dictionary of desired_goal, .* got one ndarray"):
        policy.one(np.zeros(12))
    with pytest.raises(hurcules.Error, match="as many rows in each input"):
        policy({"desired_goal": np.zeros((3, 6)), "achieved_goal": np.zeros((2, 6))})
