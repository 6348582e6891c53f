"""Step a Gymnasium environment: with the actions of its expert, then with zeros.

Run:  python python/examples/05_step_the_environment.py
"""

import gymnasium
import numpy as np

env = gymnasium.make("hurcules_envs:Hurcules/Stretch-v1", fidelity="fast")
core = env.unwrapped
for name, scale in zip(core.action_names, core.action_scale, strict=True):
    print(f"action {name:13} 1 means {scale:.3f} a second")


def episode(policy):
    """Sums the reward and its terms over an episode."""
    env.reset(seed=0)
    total, parts = 0.0, dict.fromkeys(core.environment.terms, 0.0)
    over = False
    while not over:
        _, reward, terminated, truncated, info = env.step(policy())
        total += reward
        for term in parts:
            parts[term] += info[f"reward_{term}"]
        over = terminated or truncated
    return total, parts, info


policies = {
    "expert": lambda: core.environment.expert(core.numbers)[0],
    "hold": lambda: np.zeros(env.action_space.shape, np.float32),
}
for name, policy in policies.items():
    total, parts, info = episode(policy)
    terms = "  ".join(f"{term} {value:+.3f}" for term, value in parts.items())
    print(f"{name}: {info['time']:.0f} s, reward {total:+.3f} = {terms}")
env.close()
