"""What linear laws reach, beside the expert; what is trivial: contact_environments.py --trivial.

Run:  python benchmarks/linear_laws.py [NAME ...] [--judged 20] [--generations 6]

A linear law is clip(W observation + b, -1, 1), of goal environments with the way to the goal in
the observation (`flat`). One is fitted to pushed episodes of the expert by least squares of what is
clipped. The search goes on from it by the cross-entropy method: laws drawn about a mean, of which
those with the largest return are the next mean. Each row is judged on starts that nothing was
fitted to.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules.shares import wilson
from hurcules.validation import require_known
from hurcules_envs.episodes import Episodes
from hurcules_envs.imitation import ask_expert, demonstrate
from hurcules_envs.registry import (
    fidelities_of,
    full_id,
    make_episodes,
    native_options,
    steps_of_episode,
)

NAMES = ("Reach-v0", "Drive-v0", "Press-v0", "Valve-v0", "Door-v0", "Carry-v0", "Lift-v0")
SEARCHED, JUDGED = 5_000, 20_000  # first seeds; of demonstrations 1,000
KEPT = 4  # of the laws of a generation the best one in so many is kept
SPREAD, LEAST = 0.2, 0.02  # deviation of the actions of drawn laws, at first and what is added
FITS = 30  # times the law is fitted: what is clipped as the expert's action is no error

Array = NDArray[np.float64]
Act = Callable[[Array, Episodes], Array]  # (n, o) observations to (n, k) actions


def run(name: str, act: Act, seeds: list[int], **options: Any) -> tuple[Array, Array]:
    """Successes (n,) at the end, as `evaluate` counts them, and returns (n,)."""
    n = len(seeds)
    episodes = make_episodes(name, n, 0, flat=True, **options)
    episodes.generators = [np.random.default_rng(seed) for seed in seeds]
    episodes.reset()
    seen = episodes.look(remember=None)
    success, returns, goes_on = np.zeros(n), np.zeros(n), np.ones(n, dtype=bool)
    for _ in range(steps_of_episode(name, options) or 0):
        action = act(seen.observation["observation"].astype(float), episodes)
        episodes.step(np.clip(action, -1.0, 1.0), goes_on)
        seen = episodes.look(remember=goes_on)
        returns += np.where(goes_on, seen.reward, 0.0)
        success[goes_on] = seen.info["is_success"][goes_on]
        goes_on = goes_on & ~seen.terminated
        if not goes_on.any():
            break
    return success, returns


def fitted(name: str, episodes: int, noise: float, **options: Any) -> tuple[Array, Array, Array]:
    """A law (k, o + 1) by least squares, and mean and deviation (o,) of what it sees."""
    shown = demonstrate(name, episodes, noise=noise, flat=True, **options)
    mean, deviation = shown.observations.mean(axis=0), shown.observations.std(axis=0)
    deviation[deviation < 1e-6] = 1.0
    seen = np.column_stack([(shown.observations - mean) / deviation, np.ones(len(shown.actions))])
    wanted = shown.actions.astype(float)
    law = np.linalg.lstsq(seen, wanted, rcond=1e-6)[0]
    for _ in range(FITS):
        given = seen @ law
        beyond = (np.abs(wanted) >= 1.0) & (given * np.sign(wanted) > 1.0)
        law = np.linalg.lstsq(seen, np.where(beyond, given, wanted), rcond=1e-6)[0]
    left = shown.actions - np.clip(seen @ law, -1.0, 1.0)
    varied = ((shown.actions - shown.actions.mean(axis=0)) ** 2).sum()
    share = f"{1.0 - (left**2).sum() / varied:.0%}" if varied else "none (they never change)"
    print(f"{name}: the law explains {share} of {len(left)} expert actions", flush=True)
    return law.T, mean.astype(float), deviation.astype(float)


def searched(
    name: str, law: Array, acting: Callable[[Array], Act], given: argparse.Namespace, **options: Any
) -> Array:
    """The law at which the cross-entropy method ends; each generation has one start."""
    generator, share = np.random.default_rng(0), 1.0 / np.sqrt(law.shape[1])
    spread = np.full(law.shape, share * SPREAD)
    for generation in range(given.generations):
        drawn = law + spread * generator.normal(size=(given.drawn, *law.shape))
        drawn[0] = law
        seeds = [SEARCHED + generation] * given.drawn
        _, scores = run(name, acting(drawn), seeds, **options)
        best = drawn[np.argsort(scores)[-(given.drawn // KEPT) :]]
        law, spread = best.mean(axis=0), best.std(axis=0) + share * LEAST
        print(f"{name}: generation {generation}, returns {scores[0]:.1f}, {scores.max():.1f}",
              flush=True)  # fmt: skip
    return law


def policies(name: str, given: argparse.Namespace, **options: Any) -> dict[str, Act]:
    """What is judged, by its title."""
    size = len(make_episodes(name, 1, 0, 1, **options).action_scale)
    law, mean, deviation = fitted(name, given.demonstrations, given.noise, **options)

    def acting(laws: Array) -> Act:
        def act(seen: Array, _: Episodes) -> Array:
            scaled = np.column_stack([(seen - mean) / deviation, np.ones(len(seen))])
            return np.einsum("...ko,...o->...k", laws, scaled)

        return act

    found = searched(name, law, acting, given, **options) if given.generations else None
    return {
        "linear, least squares": acting(law),
        **({} if found is None else {"linear, search": acting(found)}),
        "expert": lambda seen, episodes: ask_expert(name, episodes, (len(seen), size)),
    }


def at_least(least: int) -> Callable[[str], int]:
    """A type for argparse: whole numbers from there on."""

    def number(text: str) -> int:
        if not text.isdecimal() or int(text) < least:
            raise argparse.ArgumentTypeError(f"wanted a whole number from {least} on, got {text!r}")
        return int(text)

    return number


def asked(words: list[str] | None = None) -> tuple[argparse.Namespace, dict[str, str]]:
    """The arguments, and the fidelity of each environment by its id.

    Args:
        words: of the command; None: those of this process.
    """
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", default=NAMES)
    parser.add_argument("--fidelity", help="by default the fastest")
    parser.add_argument("--judged", type=at_least(1), default=20, help="episodes of each policy")
    parser.add_argument("--demonstrations", type=at_least(1), default=30, help="of the expert")
    parser.add_argument("--noise", type=float, default=0.3, help="of its pushes; Press wants 0.1")
    parser.add_argument("--generations", type=at_least(0), default=6, help="0: no search")
    parser.add_argument(
        "--drawn", type=at_least(KEPT), default=32, help="laws a generation, an episode each"
    )
    given = parser.parse_args(words)
    fidelities = {}
    for name in map(full_id, given.names):
        try:
            native_options(name, {})
            known = fidelities_of(name)
            chosen = given.fidelity or next(reversed(known), "")
            require_known(f"{name}: fidelity", chosen, known)
            episodes = make_episodes(name, 1, 0, 1, fidelity=chosen)
            episodes.look(remember=None)
            ask_expert(name, episodes, (1, len(episodes.action_scale)))
        except hurcules.Error as error:
            parser.error(str(error))
        fidelities[name] = chosen
    return given, fidelities


def main() -> None:
    """Prints a line a policy."""
    given, fidelities = asked()
    for name, fidelity in fidelities.items():
        options = {"fidelity": fidelity}
        seeds = [JUDGED + i for i in range(given.judged)]
        for title, act in policies(name, given, **options).items():
            start = time.perf_counter()
            success, returns = run(name, act, seeds, **options)
            low, high = wilson(int(success.sum()), len(seeds))
            print(
                f"{name:18} {fidelity:9} {title:32} {int(success.sum()):3} of "
                f"{len(seeds)} ({low:.0%} to {high:.0%}), return {returns.mean():7.2f}, "
                f"{time.perf_counter() - start:4.0f} s",
                flush=True,
            )


if __name__ == "__main__":
    main()
