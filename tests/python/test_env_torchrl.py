"""TorchRL drives the environments by its own wrappers, alone and side by side.

Strategy: its check of specs, and rollouts of the shapes that its collectors want. Its reader of
last observations (0.14.1) takes no dictionaries, so that they are flat side by side. Training with
it is not tested.
"""

import gymnasium as gym
import pytest

import hurcules_envs  # noqa: F401  registers

pytest.importorskip("torchrl", reason="pip install torchrl")
pytestmark = pytest.mark.filterwarnings("ignore")  # of TorchRL itself


@pytest.mark.parametrize("name", ["Reach-v0", "Drive-v0"])
def test_its_check_has_nothing_to_say_and_a_rollout_has_goals(name: str) -> None:
    from torchrl.envs import GymEnv
    from torchrl.envs.utils import check_env_specs

    env = GymEnv(f"Hurcules/{name}", fidelity="kinematic")
    env.set_seed(0)
    check_env_specs(env)
    rollout = env.rollout(20)
    assert rollout.batch_size == (20,)
    assert {"observation", "achieved_goal", "desired_goal"} <= set(rollout.keys())
    assert rollout["next", "reward"].isfinite().all()
    assert rollout["next", "reward"].std() > 0.0


@pytest.mark.parametrize("name", ["Reach-v0", "Drive-v0"])
def test_a_native_vector_is_reset_where_its_episodes_end(name: str) -> None:
    from torchrl.envs import GymWrapper

    vector = gym.make_vec(
        f"Hurcules/{name}", num_envs=4, fidelity="kinematic", max_episode_steps=5,
        autoreset_mode="SameStep", flat=True,
    )  # fmt: skip
    rollout = GymWrapper(vector).rollout(12, break_when_any_done=False)
    assert rollout.batch_size == (4, 12)
    assert rollout["next", "truncated"].sum() == 4 * 2  # after 5 and 10 steps
    assert rollout["next", "reward"].isfinite().all()


def test_its_reader_takes_the_info_of_a_single_environment() -> None:
    from torchrl.envs import GymEnv

    env = GymEnv("Hurcules/Drive-v0", fidelity="kinematic", action_delay=2)
    rollout = env.auto_register_info_dict().rollout(3)
    assert (rollout["next", "drawn_action_delay"] == 2).all()
    assert {"cost", "is_success"} <= set(rollout["next"].keys())
