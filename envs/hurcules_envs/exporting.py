"""Policies of Stable-Baselines3 as ONNX files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from hurcules import extras
from hurcules_envs.onnx_file import Graph, Node, texts_of, write
from hurcules_envs.sb3 import SCALE, GoalFeatures, Standardised
from hurcules_envs.torch_layers import add_layers, add_limits, add_standard

with extras.importing(extras.remedy("train")):
    from stable_baselines3.common.base_class import BaseAlgorithm

__all__ = ["export_policy"]


def export_policy(model: BaseAlgorithm, path: Path, metadata: Mapping[str, Any]) -> None:
    """Writes the deterministic policy: features, network, and the action cut to [-1, 1].

    Inputs are named as the parts of a goal environment's observation, or `observation`; the output
    is `action`.

    Args:
        model: PPO or SAC, as `hurcules_envs.training` builds them.
        path: the file.
        metadata: what the file says about itself; what is no text is written as JSON.

    Raises:
        hurcules.Error: its network has layers that are not known here.
    """
    space, actor = model.observation_space, model.policy
    weights: dict[str, Any] = {}
    nodes: list[Node] = []
    if hasattr(actor, "action_net"):  # of PPO
        features, layers = actor.pi_features_extractor, [*actor.mlp_extractor.policy_net]
        layers, squashed = [*layers, actor.action_net], False
    else:
        features, squashed = actor.actor.features_extractor, True
        layers = [*actor.actor.latent_pi, actor.actor.mu]
    if isinstance(features, GoalFeatures):
        inputs = {name: box.shape[0] for name, box in space.items()}
        parts = features.parts
        if "way" in parts:
            weights["scale"] = np.float32(SCALE)
            nodes += [
                Node("Sub", ("desired_goal", "achieved_goal"), ("away",)),
                Node("Mul", ("away", "scale"), ("way",)),
            ]
        if features.factors is not None:
            weights["factors"] = features.factors.numpy()
            nodes.append(Node("Mul", ("observation", "factors"), ("counted",)))
            parts = tuple("counted" if part == "observation" else part for part in parts)
        nodes.append(Node("Concat", parts, ("seen",), {"axis": 1}))
        used = {name for node in nodes for name in node.inputs}
        inputs = {name: size for name, size in inputs.items() if name in used}
        last = "seen"
    else:
        inputs, last = {"observation": space.shape[0]}, "observation"
    if isinstance(features, Standardised):
        last = add_standard(features.mean.numpy(), features.scale.numpy(), nodes, weights)
    last = add_layers(layers, last, nodes, weights)
    if squashed:
        nodes.append(Node("Tanh", (last,), ("action",)))
    else:
        add_limits(last, nodes, weights)
    action = {"action": model.action_space.shape[0]}
    write(path, Graph(tuple(nodes), weights, inputs, action, texts_of(metadata)))
