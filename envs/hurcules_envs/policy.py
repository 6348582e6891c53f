"""Policies as ONNX files: read, checked against an environment, and asked for actions."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

import hurcules
from hurcules_envs import onnx_file
from hurcules_envs.registry import full_id, takes

__all__ = ["Policy", "shipped"]

Array = NDArray[np.float32]
GOAL = "desired_goal"


def _gemm(a: Any, b: Any, c: Any = 0.0, **given: float) -> Any:
    left = a.T if given.get("transA", 0) else a
    right = b.T if given.get("transB", 0) else b
    return (
        np.float32(given.get("alpha", 1.0)) * (left @ right)
        + np.float32(given.get("beta", 1.0)) * c
    )


# what numpy computes; files with other operators want onnxruntime
OPERATORS: Mapping[str, Callable[..., Any]] = {
    "Add": lambda a, b: a + b,
    "Clip": lambda a, low=-np.inf, high=np.inf: np.clip(a, low, high),
    "Concat": lambda *parts, axis: np.concatenate(parts, axis=int(axis)),
    "Div": lambda a, b: a / b,
    "Elu": lambda a, alpha=1.0: np.where(a > 0, a, alpha * np.expm1(np.minimum(a, 0))),
    "Gemm": _gemm,
    "Identity": lambda a: a,
    "MatMul": lambda a, b: a @ b,
    "Mul": lambda a, b: a * b,
    "Relu": lambda a: np.maximum(a, 0),
    "Sub": lambda a, b: a - b,
    "Tanh": np.tanh,
}


_TYPES = {  # onnxruntime's names
    "tensor(uint8)": np.uint8, "tensor(double)": np.float64, "tensor(float16)": np.float16,
}  # fmt: skip


class Policy:
    """A network from observations to actions.

    Attributes:
        path: the file.
        environment: id of the environment that it was trained in; "" where the file does not say.
        options: of that environment.
        metadata: what else the file says, by name.
    """

    def __init__(self, source: str | Path) -> None:
        """Reads a policy.

        Networks of the operators above run on numpy; others run on onnxruntime where it is
        installed.

        Args:
            source: an ONNX file, a folder that `hurcules train` wrote, or the name of a policy that
                is part of the package, see `shipped`.

        Raises:
            hurcules.Error: there is none, or it is no ONNX file of one output.
        """
        self.path = _file(str(source))
        self._graph = onnx_file.read(self.path)
        self.metadata = dict(self._graph.metadata)
        self.environment = self.metadata.get("environment", "")
        try:
            options = json.loads(self.metadata.get("options", "{}"))
        except json.JSONDecodeError:
            options = None
        if not isinstance(options, dict):
            raise hurcules.Error(f"{self.path}: its options of the environment are no JSON object")
        self.options: dict[str, Any] = options
        if len(self._graph.outputs) != 1 or not self._graph.inputs:
            raise hurcules.Error(
                f"{self.path}: wanted a network with one output, the action; got the inputs "
                f"{_listed(self._graph.inputs)} and the outputs {_listed(self._graph.outputs)}"
            )
        self._session = self._other_runtime()

    def check(self, name: str, observation: spaces.Space[Any], action: spaces.Space[Any]) -> None:
        """Whether it fits an environment.

        Args:
            name: id of the environment, for the message.
            observation: space of one observation.
            action: space of one action.

        Raises:
            hurcules.Error: it has other inputs or another output; says which, and what is wanted.
        """
        trained = f"; it was trained in {self.environment}" if self.environment else ""
        boxes = observation.spaces if isinstance(observation, spaces.Dict) else {}
        if any(len(space.shape or ()) == 3 for space in boxes.values()):
            trained = f"; pictures are (n, height, width, 3){trained}"
        wanted = {key: space.shape[-1] for key, space in boxes.items() if space.shape}
        if self._flat(wanted):
            wanted = {next(iter(self._graph.inputs)): wanted["observation"] + wanted[GOAL]}
        if not wanted:
            only = next(iter(self._graph.inputs)) if len(self._graph.inputs) == 1 else "observation"
            wanted = {only: (observation.shape or (0,))[0]}
        known = {key: size for key, size in self._graph.inputs.items()}
        unfit = {key for key in known if known[key] not in (0, wanted.get(key))}
        if set(known) - set(wanted) or unfit:
            if unfit == {"observation"} and takes(name, "blind"):
                trained += "; one of flat ground fits terrain with blind=True (--set blind=true)"
            raise hurcules.Error(
                f"{self.path} does not fit {name}: wanted the inputs {_listed(wanted)}, "
                f"got {_listed(known)}{trained}"
            )
        size = next(iter(self._graph.outputs.values()))
        (numbers,) = action.shape or (0,)
        if size not in (0, numbers):
            raise hurcules.Error(
                f"{self.path} does not fit {name}: wanted {numbers} numbers of the action, "
                f"got {size}{trained}"
            )

    def __call__(self, observation: Any) -> Array:
        """Actions (n, k) in [-1, 1] for observations (n, ...), an array or a dictionary of them.

        Pictures are (n, height, width, 3).

        Raises:
            hurcules.Error: observations that lack an input of the network, of another shape or not
                of finite numbers; or the network gave numbers that are not finite.
        """
        return self._act(self._fed(observation))

    def one(self, observation: Any) -> Array:
        """The action (k,) for a single observation, an array (m,) or a dictionary of them."""
        return self._act({name: one[None] for name, one in self._fed(observation).items()})[0]

    def __repr__(self) -> str:
        """Where it acts, what goes in and how many numbers come out."""
        acts = f"{self.environment}: " if self.environment else ""
        return f"Policy({acts}{_listed(self._graph.inputs)} to {_listed(self._graph.outputs)})"

    def _act(self, fed: dict[str, Any]) -> Array:
        for name, values in fed.items():
            if values.ndim not in (2, 4):
                raise hurcules.Error(
                    f"{self.path}: wanted observations (n, m), got '{name}' of shape "
                    f"{values.shape}; one() takes a single one"
                )
            wanted = self._graph.inputs[name]
            if values.ndim == 2 and wanted not in (0, values.shape[1]):
                raise hurcules.Error(
                    f"{self.path}: wanted {wanted} numbers in '{name}', got {values.shape[1]}"
                )
        if len({len(values) for values in fed.values()}) > 1:
            shapes = ", ".join(f"'{name}' {values.shape}" for name, values in fed.items())
            raise hurcules.Error(f"{self.path}: wanted as many rows in each input, got {shapes}")
        result = self._computed(fed) if self._session is None else self._ran(fed)
        if not np.isfinite(result).all():
            for name, values in fed.items():
                if not np.isfinite(values).all():
                    raise hurcules.Error(f"{self.path}: the numbers in '{name}' are not finite")
            raise hurcules.Error(f"{self.path}: the network gave numbers that are not finite")
        return np.clip(result, -1.0, 1.0).astype(np.float32)

    def _fed(self, observation: Any) -> dict[str, Any]:
        """By input of the network, its numbers."""
        names = list(self._graph.inputs)
        given = observation
        if not isinstance(observation, Mapping):
            if len(names) > 1:
                raise hurcules.Error(
                    f"{self.path}: wanted a dictionary of {', '.join(names)}, "
                    f"got one {type(observation).__name__}"
                )
            given = {names[0]: observation}
        elif self._flat({name: np.shape(one)[-1] for name, one in given.items() if np.ndim(one)}):
            way = np.subtract(given[GOAL], given["achieved_goal"])
            given = {names[0]: np.concatenate([given["observation"], way], axis=-1)}
        if missing := ", ".join(name for name in names if name not in given):
            raise hurcules.Error(
                f"{self.path}: wanted the inputs {', '.join(names)}; not there: {missing}"
            )
        fed = {}
        for name in names:
            try:
                fed[name] = np.asarray(given[name], dtype=self._type(name))
            except (TypeError, ValueError) as error:
                raise hurcules.Error(
                    f"{self.path}: wanted an array of numbers in '{name}', got {given[name]!r}"
                ) from error
        return fed

    def _flat(self, parts: Mapping[str, int]) -> bool:
        """Whether it sees these parts of a goal environment as one array, as with `flat=True`."""
        if len(self._graph.inputs) != 1 or not {"observation", "achieved_goal", GOAL} <= set(parts):
            return False
        ((name, size),) = self._graph.inputs.items()
        return size == parts["observation"] + parts[GOAL] or (size == 0 and name not in parts)

    def _computed(self, values: dict[str, Any]) -> Any:
        known: dict[str, Any] = {**self._graph.weights, **values}
        for node in self._graph.nodes:
            inputs = [known[name] for name in node.inputs if name]
            known[node.outputs[0]] = OPERATORS[node.kind](*inputs, **node.attributes)
        return known[next(iter(self._graph.outputs))]

    def _type(self, name: str) -> Any:
        """Of the numbers that go into an input."""
        inputs = self._session.get_inputs() if self._session is not None else []
        types = {one.name: one.type for one in inputs}
        return _TYPES.get(types.get(name, ""), np.float32)

    def _ran(self, fed: dict[str, Any]) -> Any:
        """What onnxruntime computes: row by row where the file takes one only, as exporters write.

        Raises:
            hurcules.Error: it refuses these shapes.
        """
        one = self._session.get_inputs()[0].shape[:1] == [1]
        n = len(next(iter(fed.values())))
        rows = [slice(i, i + 1) for i in range(n)] if one else [slice(None)]
        try:
            parts = [
                self._session.run(None, {name: values[some] for name, values in fed.items()})[0]
                for some in rows
            ]
        except Exception as error:  # its classes have no common one
            raise hurcules.Error(f"{self.path}: {' '.join(str(error).split())}") from error
        return np.concatenate(parts)

    def _other_runtime(self) -> Any:
        others = sorted({node.kind for node in self._graph.nodes} - set(OPERATORS))
        if not others:
            return None
        try:
            import onnxruntime
        except ImportError:
            raise hurcules.Error(
                f"{self.path}: its operators {', '.join(others)} want onnxruntime: "
                "pip install onnxruntime"
            ) from None
        return onnxruntime.InferenceSession(self.path, providers=["CPUExecutionProvider"])


def shipped() -> dict[str, Path]:
    """The policies that are part of the package, by name: the id of their environment.

    A second one of an environment has a word behind it: Hurcules/Drive-v0-terrain.
    """
    folder = Path(str(files("hurcules_envs") / "policies"))
    return {f"Hurcules/{path.stem}": path for path in sorted(folder.glob("*.onnx"))}


def _file(source: str) -> Path:
    path = Path(source)
    if path.is_dir() and (path / "policy.onnx").is_file():
        return path / "policy.onnx"
    packed = path.suffix == ".zip" and path.is_file()  # of Stable-Baselines3
    if path.is_file() and not packed:
        return path
    if found := shipped().get(full_id(source)):
        return found
    what = "no policy.onnx lies there" if path.is_dir() else "no such file"
    what = "a file of Stable-Baselines3, its policy.onnx is wanted" if packed else what
    raise hurcules.Error(
        f"policy: wanted an ONNX file, a folder that train wrote, or one of "
        f"{', '.join(name.split('/')[1] for name in shipped())}; got '{source}': {what}"
    )


def _listed(sizes: Mapping[str, int]) -> str:
    return ", ".join(f"{name} ({size or '?'})" for name, size in sizes.items()) or "none"
