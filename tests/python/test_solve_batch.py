"""rhqp.solve_batch: the bits of a loop of new solvers, on any number of threads.

Strategy: all classes of hierarchies.py in one batch, so that sizes differ from problem to problem;
errors name the problem. Bad numbers inside a batch are in test_solver_arrays.py.
"""

from __future__ import annotations

import numpy as np
import pytest

import hurcules
from hierarchies import CLASSES, to_levels
from hurcules import rhqp
from other_threads import assert_they_run_during


def problems(each: int) -> list[list[rhqp.Level]]:
    return [
        to_levels(CLASSES[name](np.random.default_rng([seed, len(name)]))[1])
        for seed in range(each)
        for name in CLASSES
    ]


def unknowns(levels: list[rhqp.Level]) -> int:
    return levels[0].A.shape[1] or levels[0].rows


@pytest.mark.parametrize("threads", [None, 1, 2, 7])
def test_batch_has_the_bits_of_a_loop(threads: int | None) -> None:
    batch = problems(30)
    for levels, solution in zip(batch, rhqp.solve_batch(batch, threads), strict=True):
        alone = rhqp.Solver(unknowns(levels)).solve(levels)
        assert solution.x.tobytes() == alone.x.tobytes()
        assert (solution.status, solution.changes) == (alone.status, alone.changes)
        assert solution.optimality == alone.optimality
        for got, want in zip(solution.multipliers, alone.multipliers, strict=True):
            for g, w in zip(got, want, strict=True):
                assert g.tobytes() == w.tobytes()


def test_answers_of_a_batch_have_derivatives_and_reports() -> None:
    batch = problems(1)
    for levels, solution in zip(batch, rhqp.solve_batch(batch), strict=True):
        x_bar = np.ones(unknowns(levels))
        alone = rhqp.Solver(x_bar.size).solve(levels)
        for got, want in zip(solution.vjp(x_bar), alone.vjp(x_bar), strict=True):
            np.testing.assert_array_equal(got.lower, want.lower)
        assert [r.rank for r in solution.levels] == [r.rank for r in alone.levels]


def test_other_threads_run_during_a_batch() -> None:
    batch = problems(300)
    assert_they_run_during(lambda: rhqp.solve_batch(batch, threads=1))


def test_options_count_for_every_problem() -> None:
    options = rhqp.SolverOptions(max_changes=1)
    statuses = {s.status for s in rhqp.solve_batch(problems(10), options=options)}
    assert rhqp.Status.IterationLimit in statuses


def test_no_problems_no_answers() -> None:
    assert rhqp.solve_batch([]) == []


def test_a_generator_of_lists_is_no_sequence_but_a_tuple_is() -> None:
    box = rhqp.Bounds(np.ones(2), np.ones(2))
    assert len(rhqp.solve_batch(((box,), [box]))) == 2


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda box: rhqp.solve_batch(None), "wants a list of lists of Level, got None"),
        (lambda box: rhqp.solve_batch([[box], 3]), "problem 1, solve wants a list .* got 3"),
        (lambda box: rhqp.solve_batch([[box], [1]]), "problem 1, level 0 wants to be a Level"),
        (lambda box: rhqp.solve_batch([[]]), "problem 0, no level says how many unknowns"),
        (
            lambda box: rhqp.solve_batch([[box, rhqp.Bounds(np.ones(3), np.ones(3))]]),
            "problem 0, level 1: bounds must have length 2 .* got 3",
        ),
        (lambda box: rhqp.solve_batch([[box]], threads=0), "whole number from 1 or None, got 0"),
        (lambda box: rhqp.solve_batch([[box]], threads=True), "or None, got True"),
        (lambda box: rhqp.solve_batch([[box]], threads="x"), "or None, got 'x'"),
        (
            lambda box: rhqp.solve_batch([], options=rhqp.SolverOptions(method="magic")),
            "'magic' does not exist",
        ),
    ],
)
def test_wrong_batches_say_which_problem(make, text: str) -> None:
    with pytest.raises(hurcules.Error, match=text):
        make(rhqp.Bounds(np.ones(2), np.ones(2)))
