"""Copies and pickles of environments, and what they keep of numpy's generators."""

from __future__ import annotations

import zlib
from typing import Any

import mujoco
import numpy as np
from gymnasium.utils import EzPickle
from numpy.typing import NDArray

import hurcules

__all__ = ["GENERATOR", "Copied", "generator_numbers", "generator_state", "model_number"]

GENERATOR = 10  # numbers of a generator's state
_WORD = 32  # bits that a number holds


class Copied(EzPickle):
    """A copy, deep or by pickle, is made with the same arguments and goes on where this one is."""

    def __getstate__(self: Any) -> dict[str, Any]:
        """The arguments, and what was done since."""
        made: dict[str, Any] = EzPickle.__getstate__(self)
        return made | {"spec": self.spec, "went_on": self._went_on()}

    def __setstate__(self: Any, state: dict[str, Any]) -> None:
        """Makes it anew, and goes on."""
        EzPickle.__setstate__(self, state)
        self.spec = state["spec"]
        self._go_on(state["went_on"])


def model_number(model: mujoco.MjModel) -> float:
    """Tells models apart: shapes, places, masses and ground to 1e-6, and the period."""
    parts = (
        [model.opt.timestep],
        model.qpos0,
        model.body_pos,
        model.body_mass,
        model.geom_pos,
        model.geom_quat,
        model.geom_size,
        model.hfield_size,
        model.hfield_data,
    )
    number = 0
    for part in parts:
        number = zlib.crc32((np.round(part, 6) + 0.0).astype("<f8").tobytes(), number)
    return float(number)


def generator_numbers(generator: np.random.Generator) -> NDArray[np.float64]:
    """(GENERATOR,) the state of a generator in whole numbers below 2^32.

    Raises:
        hurcules.Error: it is not of the kind that numpy.random.default_rng makes.
    """
    state: Any = generator.bit_generator.state
    if state["bit_generator"] != "PCG64":
        raise hurcules.Error(
            f"np_random: wanted a generator of numpy.random.default_rng (PCG64), got one of "
            f"{state['bit_generator']}"
        )
    words = [state["has_uint32"], state["uinteger"]]
    for number in (state["state"]["state"], state["state"]["inc"]):
        words += [number >> (_WORD * place) & (2**_WORD - 1) for place in range(4)]
    return np.array(words, dtype=np.float64)


def generator_state(numbers: NDArray[np.float64]) -> dict[str, Any]:
    """The state of a bit generator from what `generator_numbers` gave.

    Raises:
        hurcules.Error: these are no such numbers.
    """
    if not ((numbers >= 0) & (numbers < 2**_WORD) & (numbers % 1 == 0)).all():
        raise hurcules.Error("state: wanted that of a generator of random numbers, got other ones")
    words = [int(one) for one in numbers]
    value, increment = (
        sum(word << (_WORD * place) for place, word in enumerate(part))
        for part in (words[2:6], words[6:10])
    )
    return {
        "bit_generator": "PCG64",
        "state": {"state": value, "inc": increment},
        "has_uint32": words[0],
        "uinteger": words[1],
    }
