"""Training by Stable-Baselines3: what a signal leaves, pictures of a vector.

Strategy: a few hundred steps without physics. Whether a policy learns is measured in
docs/environments.md.
"""

import json
import signal
from pathlib import Path

import numpy as np
import pytest

import hurcules
from hurcules.cli import main
from hurcules.output import WriteError
from hurcules_envs.policy import Policy

training = pytest.importorskip("hurcules_envs.training", reason="pip install 'hurcules[train]'")

OPTIONS = {"fidelity": "kinematic"}


def options(folder: Path, steps: int, **others: object) -> object:
    return training.TrainOptions(
        "Hurcules/Reach-v0", steps=steps, episodes=4, options=OPTIONS, out=folder, **others
    )


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_leaves_a_policy_and_the_next_call_goes_on(tmp_path: Path, number) -> None:
    done = []

    def stop(steps: int, share: float) -> None:
        done.append(steps)
        if steps == 40:
            signal.raise_signal(number)

    with pytest.raises(KeyboardInterrupt):
        training.train(options(tmp_path, 256), stop)
    assert done[-1] == 40
    assert float(Policy(tmp_path).metadata["steps"]) == 40
    about = Policy(tmp_path).metadata
    assert about["environment"] == "Hurcules/Reach-v0"
    assert json.loads(about["action_scale"]) == [0.3] * 6 and float(about["rate"]) == 20.0
    training.train(options(tmp_path, 256), lambda steps, share: done.append(steps))
    assert done[10:13] == [40, 0, 44] and done[-1] >= 256


def test_a_checkpoint_can_be_tried_while_training_goes_on(tmp_path: Path) -> None:
    """What is killed leaves a policy too."""
    found = {}

    def look(steps: int, share: float) -> None:
        if steps in (64, 128):
            found[steps] = float(Policy(tmp_path).metadata["steps"])

    training.train(options(tmp_path, 128, checkpoint_every=64), look)
    assert found == {64: 64.0, 128: 128.0}


def test_a_training_ends_with_a_film(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr("hurcules_envs.running.steps_of_episode", lambda *_: 3)  # a short one
    words = ["train", "Reach-v0", "--steps", "128", "--envs", "4", "--judge", "1"]
    assert main([*words, "--out", str(tmp_path)]) == 0
    summary = json.loads((tmp_path / "episode" / "summary.json").read_text())
    assert summary["options"]["fidelity"] == "exact" and summary["seed"] == 10_000
    assert (tmp_path / "episode" / "video.mp4").stat().st_size > 1_000


def test_a_folder_of_another_run_says_what_differs(tmp_path: Path) -> None:
    training.train(options(tmp_path, 128))
    with pytest.raises(hurcules.Error, match=r"seed \(there 0, now 3\); give another folder"):
        training.train(options(tmp_path, 256, seed=3))


def test_what_is_wrong_is_told_before_there_is_a_bar(
    tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    (tmp_path / "file").touch()
    words = ["train", "Reach-v0", "--fidelity", "kinematic", "--steps", "128", "--out"]
    assert main([*words, str(tmp_path / "file")]) == 2
    assert main([*words, str(tmp_path / "out"), "--algo", "dqn"]) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert f"cannot write to {tmp_path / 'file'}: it is a file" in said.err
    assert "algorithm 'dqn' does not exist" in said.err


def test_a_run_that_is_done_says_so(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    """The bar stood at 0 steps."""
    words = ["train", "Reach-v0", "--fidelity", "kinematic", "--envs", "4", "--judge", "1"]
    words += ["--no-video"]
    for told in (0, 1):
        assert main([*words, "--steps", "128", "--out", str(tmp_path)]) == 0
        assert capsys.readouterr().out.count("its 128 steps were done already") == told


def test_what_is_broken_and_a_full_disk_are_told(tmp_path: Path, monkeypatch) -> None:
    """An error of the unpacker, of the file system, and half a policy."""
    training.train(options(tmp_path, 128))
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()}

    def full(path: Path, contents: bytes) -> int:
        with path.open("wb") as file:
            file.write(contents[:10])
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(Path, "write_bytes", full)
        with pytest.raises(WriteError, match=r"cannot write .*settings\.json: No space left"):
            training.train(options(tmp_path, 256))
        patch.setattr("hurcules_envs.training.write_settings", lambda *_: None)
        with pytest.raises(WriteError, match=r"cannot write .*checkpoint\.zip: No space left"):
            training.train(options(tmp_path, 256))
    assert before == {path.name: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()}
    (tmp_path / "checkpoint.zip").write_bytes(before["checkpoint.zip"][:2000])
    with pytest.raises(hurcules.Error, match=r"checkpoint\.zip is broken: give another folder"):
        training.train(options(tmp_path, 256))
    (tmp_path / "settings.json").write_text("{")
    with pytest.raises(hurcules.Error, match=r"settings\.json is broken: give another folder"):
        training.train(options(tmp_path, 256))


def test_a_vector_draws_for_its_videos() -> None:
    vector = training.make_sb3("Reach-v0", 2, render_mode="rgb_array", **OPTIONS)
    vector.reset()
    assert vector.render_mode == "rgb_array"
    assert [picture.shape for picture in vector.get_images()] == [(368, 640, 3)] * 2
    assert vector.render().shape == (736, 640, 3)  # tiled
    vector.close()


def test_pictures_are_learnt_from_by_a_policy_of_stable_baselines3(tmp_path: Path) -> None:
    seen = {"cameras": ["head_wide"], "camera_size": (64, 48)}
    vector = training.make_sb3("Reach-v0", 2, **seen, **OPTIONS)
    model = training.PPO(
        "MultiInputPolicy", vector, n_steps=4, batch_size=8, n_epochs=1, device="cpu"
    )
    model.learn(8)
    assert "head_wide" in model.policy.features_extractor.extractors
    vector.close()
    with pytest.raises(hurcules.Error, match="cameras: train learns from numbers"):
        training.train(training.TrainOptions("Hurcules/Reach-v0", options=seen, out=tmp_path))


def test_a_run_that_goes_on_has_other_episodes(tmp_path: Path, monkeypatch) -> None:
    first = []
    reset = training.make_sb3("Hurcules/Reach-v0", 4, **OPTIONS).__class__.reset

    def noted(self):
        observation = reset(self)
        first.append({goal.tobytes() for goal in observation["observation"]})
        return observation

    monkeypatch.setattr("hurcules_envs.sb3.Sb3VecEnv.reset", noted)
    training.train(options(tmp_path, 128))
    training.train(options(tmp_path, 256))
    assert len(first) == 2 and not first[0] & first[1]


def test_a_folder_that_was_moved_holds_the_same_run(tmp_path: Path) -> None:
    training.train(options(tmp_path / "here", 128))
    (tmp_path / "here").rename(tmp_path / "there")
    done = []
    training.train(options(tmp_path / "there", 256), lambda steps, share: done.append(steps))
    assert done[:2] == [0, 132]
    with pytest.raises(hurcules.Error, match=r"holds another run: seed \(there 0, now 1\); give"):
        training.train(options(tmp_path / "there", 256, seed=1))


def test_options_of_a_reset_hold_in_a_vector_of_stable_baselines3() -> None:
    ones = np.ones((2, 6), dtype=np.float32)

    def seen(**given):
        vector = training.make_sb3("Hurcules/Reach-v0", 2, **OPTIONS)
        vector.seed(3)
        vector.set_options(given)
        vector.reset()
        assert [info["drawn_action_delay"] for info in vector.reset_infos] == 2 * [
            given.get("action_delay", 0)
        ]
        return vector.step(ones)[0]["observation"]

    assert not np.array_equal(seen(), seen(action_delay=3))
    vector = training.make_sb3("Hurcules/Reach-v0", 2, **OPTIONS)
    vector.set_options([{"action_delay": 1}, {}])
    with pytest.raises(hurcules.Error, match="set_options: wanted the same options"):
        vector.reset()
    with pytest.raises(hurcules.Error, match="reset option 'delay' does not exist"):
        vector.set_options({"delay": 1})
        vector.reset()


def test_a_curriculum_of_stable_baselines3_sets_ranges_and_no_other_name() -> None:
    vector = training.make_sb3("Drive-v0", 2, fidelity="fast", max_episode_steps=2)
    vector.reset()
    vector.set_attr("mass", (1.1, 1.2))
    assert vector.get_attr("mass") == [(1.1, 1.2)] * 2
    action = np.zeros((2, *vector.action_space.shape))
    infos = [vector.step(action)[3][0] for _ in range(4)]
    assert [info["cost"] for info in infos] == [0.0] * 4
    assert infos[1]["drawn_mass"] == 1.0
    assert infos[3]["drawn_mass"] > 1.0
    with pytest.raises(hurcules.Error, match="the vector has no attribute 'masses'"):
        vector.set_attr("masses", 2.0)
    with pytest.raises(hurcules.Error, match="wanted all episodes"):
        vector.set_attr("mass", 2.0, indices=[1])
    seen = vector.env_method("reset", seed=0)
    assert seen[0] is seen[1]


@pytest.mark.parametrize("name", ["Reach", "Drive"])
def test_infos_of_stable_baselines3_give_the_reward_of_the_step(name: str) -> None:
    vector = training.make_sb3(f"Hurcules/{name}-v0", 2, **OPTIONS)
    vector.seed(0)
    vector.reset()
    generator = np.random.default_rng(0)
    for _ in range(120):  # beyond the end of an episode of Reach
        action = generator.uniform(-1, 1, (2, *vector.action_space.shape))
        seen, rewards, dones, infos = vector.step(action)
        for i in range(2):
            last = infos[i]["terminal_observation"] if dones[i] else {n: seen[n][i] for n in seen}
            (again,) = vector.env_method(
                "compute_reward", last["achieved_goal"], last["desired_goal"], infos[i]
            )
            assert np.float32(again) == rewards[i]
