"""Random surfaces z(x, y) with a given spectrum, as arrays of heights.

A surface is white noise times the square root of its two-sided density S(n) of the wave number
n = |(n_x, n_y)| [cycles/m], on a grid that is larger than what is returned, so that it does not
repeat. A straight cut through a surface with S(n) = C n^-3 has the one-sided density

    G(n_x) = 2 integral S dn_y = 4 C / n_x^2,

so that ISO 8608, G(n) = G(n_0) (n / n_0)^-2 with n_0 = 0.1 cycles/m, wants C = G(n_0) n_0^2 / 4.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["PAD", "bumps", "fade_to_pad", "road"]

N0 = 0.1  # [cycles/m] where ISO 8608 states the density
LONGEST = 100.0  # [m] ISO 8608 begins at 0.01 cycles/m
PAD = (-1.5, 1.5, -1.0, 1.0)  # [m] x and y of a level pad round the start, a geom of its own
FADE = 1.5  # [m] from level to rough
SUNK = 0.05  # [m] the surface below the pad: a track has fewer contacts with one box


def road(
    rng: np.random.Generator, shape: tuple[int, int], cell: float, density: float
) -> NDArray[np.float64]:
    """A surface after ISO 8608.

    Args:
        rng: draws it.
        shape: of the heights.
        cell: distance between heights [m].
        density: G(n_0) of every straight cut [m3].

    Returns:
        Heights [m] with mean zero.
    """
    factor = density * N0**2 / 4
    full = [_even(2 * size) for size in shape]
    nx, ny = np.fft.fftfreq(full[1], cell), np.fft.fftfreq(full[0], cell)
    n = np.hypot(nx[None, :], ny[:, None])
    spectrum = np.where(n >= 1 / LONGEST, factor / np.maximum(n, 1 / LONGEST) ** 3, 0.0)
    noise = np.fft.fft2(rng.standard_normal(full))
    heights = np.fft.ifft2(noise * np.sqrt(spectrum) / cell).real[: shape[0], : shape[1]]
    return heights - heights.mean()


def bumps(rng: np.random.Generator, shape: tuple[int, int], breadth: float) -> NDArray[np.float64]:
    """Bumps of one size.

    Args:
        rng: draws them.
        shape: of the heights.
        breadth: of a bump, in cells.

    Returns:
        Heights with mean 0 and standard deviation 1.
    """
    full = [_even(2 * size) for size in shape]
    nx, ny = np.fft.fftfreq(full[1]), np.fft.fftfreq(full[0])
    smooth = np.exp(-0.5 * (np.pi * breadth) ** 2 * (nx[None, :] ** 2 + ny[:, None] ** 2))
    noise = np.fft.fft2(rng.standard_normal(full))
    heights = np.fft.ifft2(noise * smooth).real[: shape[0], : shape[1]]
    return (heights - heights.mean()) / heights.std()


def fade_to_pad(
    heights: NDArray[np.float64], corner: tuple[float, float], cell: float
) -> NDArray[np.float64]:
    """The same surface, at z = 0 round the pad, sunk below it, rough again after FADE.

    Args:
        heights: (rows along y, columns along x) [m].
        corner: x and y of the first height [m].
        cell: [m].
    """
    y, x = np.mgrid[: heights.shape[0], : heights.shape[1]] * cell
    x, y = x + corner[0], y + corner[1]
    beyond_x = np.maximum(np.maximum(PAD[0] - x, x - PAD[1]), 0.0)
    beyond_y = np.maximum(np.maximum(PAD[2] - y, y - PAD[3]), 0.0)
    beyond = np.hypot(beyond_x, beyond_y)
    u = np.clip(beyond / FADE, 0.0, 1.0)
    inside = np.minimum.reduce([x - PAD[0], PAD[1] - x, y - PAD[2], PAD[3] - y])
    return heights * u**2 * (3 - 2 * u) - SUNK * (inside > 0.5 * cell)


def _even(size: int) -> int:
    return size + size % 2
