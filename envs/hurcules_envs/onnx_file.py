"""ONNX files of small networks, written and read without the package onnx.

An ONNX file is a protobuf message; the numbers of its fields are those of onnx.proto (IR version 8,
operators 13). What is written here any program that knows ONNX reads.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules.output import write_whole

__all__ = ["Graph", "Node", "read", "texts_of", "write"]

IR_VERSION, OPERATORS = 8, 13
FLOAT = 1  # TensorProto.DataType
_TYPES: Mapping[int, Any] = {
    FLOAT: np.float32, 2: np.uint8, 3: np.int8, 6: np.int32, 7: np.int64, 9: np.bool_,
    10: np.float16, 11: np.float64,
}  # fmt: skip
_ATTRIBUTE_FLOAT, _ATTRIBUTE_INT = 1, 2  # AttributeProto.AttributeType

Message = dict[int, list[Any]]  # by the number of a field, its values


@dataclass(frozen=True)
class Node:
    """One operator: names of what goes in and comes out, and its attributes (numbers)."""

    kind: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    attributes: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Graph:
    """A network.

    Attributes:
        nodes: in the order in which they are computed.
        weights: by name.
        inputs: by name how many numbers a row has; 0: not said.
        outputs: likewise.
        metadata: by name a text.
    """

    nodes: tuple[Node, ...]
    weights: Mapping[str, NDArray[Any]]
    inputs: Mapping[str, int]
    outputs: Mapping[str, int]
    metadata: Mapping[str, str] = field(default_factory=dict)


def texts_of(about: Mapping[str, Any]) -> dict[str, str]:
    """What a file says about itself as the metadata of a graph: what is no text as JSON."""
    return {name: one if isinstance(one, str) else json.dumps(one) for name, one in about.items()}


def write(path: Path, graph: Graph) -> None:
    """Writes a graph; weights as float32, inputs and outputs as (n, size) float32.

    Raises:
        hurcules.output.WriteError: the file cannot be written; an earlier one stays.
    """
    content: list[tuple[int, Any]] = [(1, _node(node)) for node in graph.nodes]
    content += [(2, "policy")]
    content += [(5, _tensor(name, values)) for name, values in graph.weights.items()]
    content += [(11, _value(name, size)) for name, size in graph.inputs.items()]
    content += [(12, _value(name, size)) for name, size in graph.outputs.items()]
    model: list[tuple[int, Any]] = [(1, IR_VERSION), (2, "hurcules"), (7, _encoded(content))]
    model += [(8, _encoded([(1, ""), (2, OPERATORS)]))]
    model += [(14, _encoded([(1, n), (2, text)])) for n, text in graph.metadata.items()]
    write_whole(path, _encoded(model))


def read(path: Path) -> Graph:
    """Reads a graph.

    Raises:
        hurcules.Error: the file cannot be read or is no ONNX file.
    """
    try:
        model = _decoded(path.read_bytes())
        graph = _decoded(model[7][-1])
        weights = dict(_named_tensor(one, path.parent) for one in graph.get(5, []))
        sizes = [dict(_named_size(one) for one in graph.get(number, [])) for number in (11, 12)]
        entries = [_decoded(one) for one in model.get(14, [])]
        return Graph(
            nodes=tuple(_read_node(one) for one in graph.get(1, [])),
            weights=weights,
            inputs={name: size for name, size in sizes[0].items() if name not in weights},
            outputs=sizes[1],
            metadata={_text(entry, 1): _text(entry, 2) for entry in entries},
        )
    except OSError as error:
        what = error.filename or path
        raise hurcules.Error(f"{what}: cannot be read: {error.strerror}") from error
    except (KeyError, IndexError, ValueError, TypeError, AttributeError, struct.error) as error:
        raise hurcules.Error(f"{path}: wanted an ONNX file, got another or a broken one") from error


def _node(node: Node) -> bytes:
    fields: list[tuple[int, Any]] = [(1, name) for name in node.inputs]
    fields += [(2, name) for name in node.outputs] + [(4, node.kind)]
    for name, value in node.attributes.items():
        if isinstance(value, int):
            fields.append((5, _encoded([(1, name), (3, value), (20, _ATTRIBUTE_INT)])))
        else:
            fields.append((5, _encoded([(1, name), (2, value), (20, _ATTRIBUTE_FLOAT)])))
    return _encoded(fields)


def _tensor(name: str, values: NDArray[Any]) -> bytes:
    array = np.asarray(values, dtype="<f4")  # keeps scalars what they are
    shape: list[tuple[int, Any]] = [(1, size) for size in array.shape]
    return _encoded([*shape, (2, FLOAT), (8, name), (9, array.tobytes())])


def _value(name: str, size: int) -> bytes:
    shape = _encoded([(1, _encoded([(2, "n")])), (1, _encoded([(1, size)]))])
    return _encoded([(1, name), (2, _encoded([(1, _encoded([(1, FLOAT), (2, shape)]))]))])


def _encoded(fields: Iterable[tuple[int, Any]]) -> bytes:
    """A message: whole numbers as varints, floats in 4 bytes, texts and bytes with their length."""
    parts = []
    for number, value in fields:
        if isinstance(value, int):
            parts += [_varint(number << 3), _varint(value)]
        elif isinstance(value, float):
            parts += [_varint(number << 3 | 5), struct.pack("<f", value)]
        else:
            data = value.encode() if isinstance(value, str) else value
            parts += [_varint(number << 3 | 2), _varint(len(data)), data]
    return b"".join(parts)


def _varint(value: int) -> bytes:
    value &= 2**64 - 1  # negative numbers as two's complement
    parts = bytearray()
    while value > 127:
        parts.append(value & 127 | 128)
        value >>= 7
    parts.append(value)
    return bytes(parts)


def _decoded(data: bytes) -> Message:
    message: Message = {}
    place = 0
    while place < len(data):
        key, place = _read_varint(data, place)
        kind = key & 7
        value: Any
        if kind == 0:
            value, place = _read_varint(data, place)
        elif kind in (1, 5):
            size = 8 if kind == 1 else 4
            value, place = (
                struct.unpack_from("<d" if kind == 1 else "<f", data, place)[0],
                place + size,
            )
        elif kind == 2:
            size, place = _read_varint(data, place)
            if place + size > len(data):
                raise ValueError("cut short")
            value, place = data[place : place + size], place + size
        else:
            raise ValueError("no message")
        message.setdefault(key >> 3, []).append(value)
    return message


def _read_varint(data: bytes, place: int) -> tuple[int, int]:
    value = shift = 0
    while True:
        byte = data[place]
        value |= (byte & 127) << shift
        place, shift = place + 1, shift + 7
        if byte < 128:
            return value - 2**64 if value >= 2**63 else value, place


def _whole(values: Iterable[Any]) -> Iterator[int]:
    """Repeated whole numbers, packed or one by one."""
    for value in values:
        if isinstance(value, int):
            yield value
            continue
        place = 0
        while place < len(value):
            one, place = _read_varint(value, place)
            yield one


def _text(message: Message, number: int) -> str:
    return str(message[number][-1].decode()) if number in message else ""


def _read_node(data: bytes) -> Node:
    message = _decoded(data)
    attributes: dict[str, float] = {}
    for one in message.get(5, []):
        entry = _decoded(one)
        value = entry.get(3, entry.get(2))
        attributes[_text(entry, 1)] = value[-1] if value else float("nan")
    names = [tuple(name.decode() for name in message.get(number, [])) for number in (1, 2)]
    return Node(_text(message, 4), names[0], names[1], attributes)


def _beside(message: Message, folder: Path) -> bytes:
    """The bytes of a tensor that lie in a file of their own, as PyTorch writes them."""
    entries = [_decoded(one) for one in message[13]]
    said = {_text(entry, 1): _text(entry, 2) for entry in entries}
    data = (folder / Path(said["location"]).name).read_bytes()[int(said.get("offset", 0)) :]
    return data[: int(said.get("length", len(data)))]


def _named_tensor(data: bytes, folder: Path) -> tuple[str, NDArray[Any]]:
    message = _decoded(data)
    shape = tuple(_whole(message.get(1, [])))
    kind = _TYPES[message[2][-1]]
    if message.get(14) == [1]:  # external
        message[9] = [_beside(message, folder)]
    if 9 in message:
        values = np.frombuffer(message[9][-1], dtype=np.dtype(kind).newbyteorder("<"))
    elif kind is np.int64:
        values = np.array(list(_whole(message.get(7, []))), dtype=np.int64)
    elif kind not in (np.float32, np.float64):  # float16 as its bits
        whole = np.array(list(_whole(message.get(5, []))), dtype=np.int64)
        values = whole.astype(np.uint16).view(kind) if kind is np.float16 else whole.astype(kind)
    else:
        parts = message.get(4 if kind is np.float32 else 10, [])
        values = np.concatenate([
            np.frombuffer(part, dtype=kind) if isinstance(part, bytes) else np.array([part], kind)
            for part in parts
        ])  # fmt: skip
    return _text(message, 8), values.reshape(shape)


def _named_size(data: bytes) -> tuple[str, int]:
    message = _decoded(data)
    tensor = _decoded(_decoded(message[2][-1])[1][-1])
    dims = [_decoded(one) for one in _decoded(tensor[2][-1]).get(1, [])] if 2 in tensor else []
    return _text(message, 1), int(dims[-1].get(1, [0])[-1]) if dims else 0
