"""Behaviour cloning: the networks of PPO start from what a scripted expert does."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from numpy.typing import NDArray

from hurcules import extras
from hurcules_envs.imitation import Demonstrations
from hurcules_envs.sb3 import Standardised

with extras.importing(extras.remedy("train")):
    import torch
    from stable_baselines3 import PPO
    from stable_baselines3.common.utils import obs_as_tensor

__all__ = ["clone"]

EPOCHS, BATCH, RATE = 150, 256, 2e-3  # samples a step, learning rate, which falls to 0


def clone(model: PPO, shown: Demonstrations, seed: int) -> None:
    """Teaches the actor what the expert did, and the critic what that was worth.

    The critic learns too, since PPO would unlearn with a critic that knows nothing: all that
    the actor does would seem a surprise.

    Args:
        model: untrained; changed in place.
        shown: by the expert.
        seed: of the order in which they are gone through.
    """
    policy = model.policy
    if isinstance(policy.features_extractor, Standardised):
        policy.features_extractor.update(shown.observations)
    wanted = torch.as_tensor(shown.actions)
    returns = torch.as_tensor(shown.returns(model.gamma))
    generator = torch.Generator().manual_seed(seed)
    optimiser = torch.optim.Adam(policy.parameters(), lr=RATE)
    steps = EPOCHS * -(-len(wanted) // BATCH)
    schedule = torch.optim.lr_scheduler.LinearLR(optimiser, 1.0, 0.0, steps)
    for _ in range(EPOCHS):
        for rows in torch.randperm(len(wanted), generator=generator).split(BATCH):
            seen = obs_as_tensor(_chosen(shown.observations, rows.numpy()), model.device)
            action = policy.get_distribution(seen).mode().clamp(-1.0, 1.0)
            value = policy.predict_values(seen)[:, 0]
            loss = ((action - wanted[rows]) ** 2).mean() + ((value - returns[rows]) ** 2).mean()
            optimiser.zero_grad()
            loss.backward()
            optimiser.step()
            schedule.step()


def _chosen(seen: Any, rows: NDArray[Any]) -> Any:
    if isinstance(seen, Mapping):
        return {name: values[rows] for name, values in seen.items()}
    return seen[rows]
