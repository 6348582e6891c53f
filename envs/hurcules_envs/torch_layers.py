"""Layers of PyTorch as nodes of an ONNX file."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import torch
from torch import nn

import hurcules
from hurcules_envs.onnx_file import Node

__all__ = ["add_layers", "add_limits", "add_standard"]

_ACTIVATIONS = {nn.Tanh: "Tanh", nn.ReLU: "Relu"}


def add_layers(
    layers: Iterable[nn.Module], last: str, nodes: list[Node], weights: dict[str, Any]
) -> str:
    """Adds the nodes of a network behind `last`; gives the name of what comes out."""
    for i, layer in enumerate(layers):
        out = f"layer_{i}"
        if isinstance(layer, nn.Linear):
            for name, values in (("weight", layer.weight), ("bias", layer.bias)):
                weights[f"{name}_{i}"] = values.detach().to(torch.float32).numpy()
            inputs = (last, f"weight_{i}", f"bias_{i}")
            nodes.append(Node("Gemm", inputs, (out,), {"transB": 1}))
        elif type(layer) in _ACTIVATIONS:
            nodes.append(Node(_ACTIVATIONS[type(layer)], (last,), (out,)))
        else:
            raise hurcules.Error(f"ONNX: the layer {type(layer).__name__} is not known")
        last = out
    return last


def add_standard(mean: Any, spread: Any, nodes: list[Node], weights: dict[str, Any]) -> str:
    """Adds what takes `observation` to mean 0 and spread 1; gives the name of what comes out."""
    weights |= {"mean": mean, "spread": spread}
    nodes += [
        Node("Sub", ("observation", "mean"), ("centred",)),
        Node("Div", ("centred", "spread"), ("seen",)),
    ]
    return "seen"


def add_limits(last: str, nodes: list[Node], weights: dict[str, Any]) -> None:
    """Adds the output `action`: what stands in `last`, cut to [-1, 1]."""
    weights |= {"least": np.float32(-1.0), "most": np.float32(1.0)}
    nodes.append(Node("Clip", (last, "least", "most"), ("action",)))
