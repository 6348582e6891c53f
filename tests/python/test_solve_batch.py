"""rhqp.solve_batch: the bits of a loop of new solvers, on any number of threads.

Strategy: all classes of hierarchies.py in one batch, so that sizes differ from problem to problem;
stacked arrays against the same hierarchies one by one; errors name the problem. Bad numbers inside
a batch of lists are in test_solver_arrays.py.
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


COUNT, N, ROWS = 40, 9, (3, 2, 4)


def stacks(rng: np.random.Generator) -> list[rhqp.LevelStack]:
    """A box for all; rows of each; rows for all with targets of each; targets for all."""
    A = [rng.standard_normal((COUNT, m, N)) for m in ROWS]
    y = [rng.standard_normal((COUNT, m)) for m in ROWS]
    return [
        rhqp.BoundsStack(np.full(N, -0.5), np.full(N, 0.5)),
        rhqp.LevelStack(A[0], y[0], y[0], 0.1),
        rhqp.LevelStack(A[1][0], y[1], y[1] + 0.1, 0.1),
        rhqp.LevelStack(A[2], y[2][0], y[2][0], 0.1),
    ]


def slice_of(stack: rhqp.LevelStack, i: int) -> rhqp.Level:
    lower, upper = (v[i] if v.ndim == 2 else v for v in (stack.lower, stack.upper))
    if stack.A.size == 0:
        return rhqp.Bounds(lower, upper)
    return rhqp.Level(stack.A[i] if stack.A.ndim == 3 else stack.A, lower, upper, stack.rho)


@pytest.mark.parametrize("threads", [None, 1, 2, 7])
@pytest.mark.parametrize("handover", ["strict", "smooth"])
def test_stacked_arrays_have_the_bits_of_a_loop(threads: int | None, handover: str) -> None:
    given = stacks(np.random.default_rng(1))
    options = rhqp.SolverOptions(handover=handover)
    solutions = rhqp.solve_batch(given, threads, options)
    assert len(solutions) == COUNT
    for i, solution in enumerate(solutions):
        alone = rhqp.Solver(N, options).solve([slice_of(stack, i) for stack in given])
        assert solution.x.tobytes() == alone.x.tobytes()
        assert (solution.status, solution.changes) == (alone.status, alone.changes)
        assert solution.optimality == alone.optimality


def test_stacks_hold_their_arrays_and_read_them_anew() -> None:
    y = np.zeros((3, 1))
    given = [rhqp.LevelStack(np.ones((1, 1)), y, y)]
    y[2] = 7.0
    assert [s.x[0] for s in rhqp.solve_batch(given)] == [0.0, 0.0, 7.0]
    y.resize((1, 3), refcheck=False)  # in place
    with pytest.raises(hurcules.Error, match=r"A must be \(3, 1\)"):
        rhqp.solve_batch(given)


def test_stacks_of_one_slice_are_one_problem_and_of_none_are_none() -> None:
    one = rhqp.LevelStack(np.eye(2), np.ones(2), np.ones(2))
    assert [s.x.tolist() for s in rhqp.solve_batch([one])] == [[1.0, 1.0]]
    none = rhqp.LevelStack(np.eye(2), np.ones((0, 2)), np.ones((0, 2)))
    assert rhqp.solve_batch([none]) == []


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda A, y: rhqp.LevelStack(A, y[:3], y), r"as many slices.*\(4, 2, 3\), \(3, 2\)"),
        (lambda A, y: rhqp.LevelStack(A[0, 0], y, y), r"A wants .* \(m, n\) or \(B, m, n\)"),
        (
            lambda A, y: rhqp.LevelStack(A, y[:, :1], y),
            "slice 0: lower and upper must have one length",
        ),
        (lambda A, y: rhqp.LevelStack(A, y, y - 1.0), "slice 0, row 0"),
        (lambda A, y: rhqp.BoundsStack(y, np.full(2, np.nan)), "slice 0, row 0"),
        (lambda A, y: rhqp.LevelStack(A, y, y, -1.0), "slice 0: rho"),
        (lambda A, y: rhqp.solve_batch([rhqp.LevelStack(A, y, y), 3]), "level 1 wants to be a Le"),
        (
            lambda A, y: rhqp.solve_batch(
                [rhqp.LevelStack(A, y, y), rhqp.LevelStack(A[:3], y[:3], y[:3])]
            ),
            "level 1 is of 3 hierarchies, those above are of 4",
        ),
        (
            lambda A, y: rhqp.solve_batch([rhqp.LevelStack(A, y, y), rhqp.BoundsStack(y, y)]),
            "problem 0, level 1: bounds must have length 3",
        ),
    ],
)
def test_wrong_stacks_say_what_is_wrong(make, text: str) -> None:
    with pytest.raises(hurcules.Error, match=text):
        make(np.ones((4, 2, 3)), np.ones((4, 2)))


def test_numbers_that_go_bad_name_problem_level_and_row() -> None:
    y = np.zeros((4, 2))
    given = [rhqp.LevelStack(np.ones((4, 2, 3)), y, y)]
    y[2, 1] = np.nan
    with pytest.raises(hurcules.Error, match="problem 2, level 0, row 1"):
        rhqp.solve_batch(given)


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
        (lambda box: rhqp.solve_batch(None), "lists of Level, or of LevelStack, got None"),
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
