"""Training by Stable-Baselines3: what a signal leaves, pictures of a vector.

Strategy: a few hundred steps without physics. Whether a policy learns is measured in
docs/environments.md.
"""

import signal
from pathlib import Path

import pytest

import hurcules
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
    assert Policy(tmp_path).environment == "Hurcules/Reach-v0"
    training.train(options(tmp_path, 256), lambda steps, share: done.append(steps))
    assert done[10] == 44 and done[-1] >= 256


def test_a_folder_of_another_run_says_what_differs(tmp_path: Path) -> None:
    training.train(options(tmp_path, 128))
    with pytest.raises(hurcules.Error, match=r"seed \(there 0, now 3\): give another folder"):
        training.train(options(tmp_path, 256, seed=3))


def test_a_vector_draws_for_its_videos() -> None:
    vector = training.make_sb3("Hurcules/Reach-v0", 2, render_mode="rgb_array", **OPTIONS)
    vector.reset()
    assert vector.render_mode == "rgb_array"
    assert [picture.shape for picture in vector.get_images()] == [(368, 640, 3)] * 2
    assert vector.render().shape == (736, 640, 3)  # tiled
    vector.close()
