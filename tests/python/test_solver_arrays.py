"""What Python's levels share with the solver: memory, time, threads, and what bad numbers do there.

Strategy: numpy's own word on shared memory; a thread that counts while a solve runs; the same bits
from held and from copied arrays; numbers that go bad after a level was made are found by the solve,
with level and row. Shapes refused when a level is made are in test_solver.py.
"""

from __future__ import annotations

import copy
import gc
import pickle
import threading
import weakref
from collections.abc import Callable, Sequence

import numpy as np
import pytest

import hurcules
from hierarchies import CLASSES, to_levels
from hurcules import rhqp
from other_threads import assert_they_run_during


def equality(A: np.ndarray, b: np.ndarray, rho: float = 0.0) -> rhqp.Level:
    return rhqp.Level(A, b, b, rho)


def large(n: int) -> list[rhqp.Level]:
    """Takes some tenths of a second when cold."""
    rng = np.random.default_rng(0)
    ones = np.ones(n)
    return [
        rhqp.Bounds(-0.05 * ones, 0.05 * ones),
        equality(rng.standard_normal((n // 2, n)), rng.standard_normal(n // 2), 0.1),
        equality(rng.standard_normal((n // 4, n)), rng.standard_normal(n // 4), 0.1),
    ]


def test_contiguous_doubles_are_held_not_copied() -> None:
    A, b, c = np.eye(3), np.zeros(3), np.ones(3)
    level, box = rhqp.Level(A, b, c), rhqp.Bounds(b, c)
    for held, given in ((level.A, A), (level.lower, b), (level.upper, c), (box.lower, b)):
        assert held is given
        assert np.shares_memory(held, given)
    view = np.zeros((4, 3))[1:]  # rows of a larger array are contiguous too
    assert np.shares_memory(rhqp.Level(view, b, c).A, view)


@pytest.mark.parametrize(
    "A",
    [
        np.arange(6).reshape(2, 3),
        np.arange(6.0, dtype=np.float32).reshape(2, 3),
        np.asfortranarray(np.arange(6.0).reshape(2, 3)),
        np.arange(12.0).reshape(2, 6)[:, ::2],
        np.arange(6.0).reshape(2, 3).astype(">f8"),
        np.frombuffer(b"x" + np.arange(6.0).tobytes(), np.float64, offset=1).reshape(2, 3),
        [[0, 1, 2], [3, 4, 5]],
    ],
    ids=["int", "float32", "fortran", "strided", "big-endian", "unaligned", "list"],
)
def test_all_else_is_converted_once(A: object) -> None:
    level = rhqp.Level(A, [0, 0], [1, 1])  # type: ignore[arg-type]
    assert level.A.dtype == np.float64 and level.A.flags.c_contiguous and level.A.flags.aligned
    np.testing.assert_array_equal(level.A, np.asarray(A, dtype=np.float64))
    assert not isinstance(A, np.ndarray) or not np.shares_memory(level.A, A)


def test_what_is_written_into_an_array_is_seen_by_the_next_solve() -> None:
    A, b = np.eye(2), np.array([1.0, 2.0])
    levels, solver = [equality(A, b)], rhqp.Solver(2)
    np.testing.assert_allclose(solver.solve(levels).x, [1.0, 2.0])
    b[1] = -4.0
    np.testing.assert_allclose(solver.solve(levels).x, [1.0, -4.0])
    A[0, 0] = 2.0
    np.testing.assert_allclose(solver.solve(levels).x, [0.5, -4.0])


@pytest.mark.parametrize("name", CLASSES)
def test_held_and_copied_arrays_give_the_same_bits(name: str) -> None:
    for seed in range(50):
        n, rows = CLASSES[name](np.random.default_rng([seed, len(name)]))
        held = rhqp.Solver(n).solve(to_levels(rows))
        for level in rows:
            level.A = np.asfortranarray(level.A)
        copied = rhqp.Solver(n).solve(to_levels(rows))
        assert held.x.tobytes() == copied.x.tobytes(), f"seed {seed}"
        assert held.optimality == copied.optimality


def test_an_answer_is_of_its_solve_whatever_comes_later() -> None:
    n, rows = CLASSES["mixed"](np.random.default_rng(4))
    levels, solver = to_levels(rows), rhqp.Solver(n)
    solution, fresh = solver.solve(levels), rhqp.Solver(n).solve(levels)
    wanted = [[m.copy() for m in of] for of in fresh.multipliers]
    x = fresh.x.copy()
    for level in levels:
        level.A[...], level.lower[...], level.upper[...] = 1.0, -1.0, 1.0
    solver.solve(levels)
    del solver, levels
    gc.collect()
    np.testing.assert_array_equal(solution.x, x)
    for got, want in zip(solution.multipliers, wanted, strict=True):
        for g, w in zip(got, want, strict=True):
            np.testing.assert_array_equal(g, w)
    with pytest.raises(ValueError, match="read-only"):
        solution.x[0] = 1.0


def test_a_level_keeps_its_arrays_alive_and_lets_them_go() -> None:
    class Watched(np.ndarray):
        pass

    A = np.eye(2).view(Watched)
    level = equality(A, np.ones(2))
    gone = weakref.ref(A)
    del A
    np.testing.assert_allclose(rhqp.Solver(2).solve([level]).x, [1.0, 1.0])
    del level
    gc.collect()
    assert gone() is None


@pytest.mark.parametrize(
    "twin",
    [lambda one: pickle.loads(pickle.dumps(one)), copy.deepcopy, copy.copy],
    ids=["pickle", "deepcopy", "copy"],
)
def test_levels_are_pickled_and_copied(twin: Callable[[object], object]) -> None:
    rng = np.random.default_rng(0)
    A, b = rng.standard_normal((2, 3)), rng.standard_normal(2)
    levels = [
        rhqp.Bounds(-np.ones(3), [1.0, np.inf, 0.5]),
        rhqp.Level(A, b, [b[0], np.inf], rho=1e-9),
        rhqp.Level(np.zeros((0, 3)), [], []),
    ]
    copies = twin(levels) if twin is not copy.copy else list(map(twin, levels))
    assert [level.rho for level in copies] == [0.0, 1e-9, 0.0]
    bits = [rhqp.Solver(3).solve(some).x.tobytes() for some in (levels, copies)]
    assert bits[0] == bits[1]
    stacks = [
        rhqp.BoundsStack(-np.ones((4, 3)), np.ones((4, 3))),
        rhqp.LevelStack(A, rng.standard_normal((4, 2)), np.full((4, 2), np.inf), 0.1),
    ]
    for one, other in zip(
        rhqp.solve_batch(stacks), rhqp.solve_batch(list(map(twin, stacks))), strict=True
    ):
        assert one.x.tobytes() == other.x.tobytes()
    change = twin(rhqp.LevelChange(lower=[1.0, 2.0], rho=0.5))
    assert change.A is None and change.lower.tolist() == [1.0, 2.0] and change.rho == 0.5


def test_other_threads_run_during_a_solve() -> None:
    levels, solver = large(160), rhqp.Solver(160)
    assert_they_run_during(lambda: solver.solve(levels))


def test_threads_that_share_a_solver_take_turns() -> None:
    n, rows = CLASSES["box_conflict"](np.random.default_rng(2))
    levels, solver = to_levels(rows), rhqp.Solver(n)
    wanted, wrong = solver.solve(levels).x, []

    def work() -> None:
        for _ in range(200):
            x = solver.solve(levels).x
            if not np.allclose(x, wanted, atol=1e-9):
                wrong.append(x)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == []


def test_levels_that_nobody_else_holds_live_as_long_as_the_solve() -> None:
    class Fleeting(Sequence[rhqp.Level]):
        def __len__(self) -> int:
            return 3

        def __getitem__(self, k):  # type: ignore[no-untyped-def]
            level = large(60)[k]
            if k == 0:
                return rhqp.Bounds(level.lower.copy(), level.upper.copy())
            return rhqp.Level(level.A.copy(), level.lower.copy(), level.upper.copy(), level.rho)

    wanted = rhqp.Solver(60).solve(large(60))
    for _ in range(5):
        solution = rhqp.Solver(60).solve(Fleeting())
        assert solution.x.tobytes() == wanted.x.tobytes()
    batch = rhqp.solve_batch([Fleeting(), Fleeting()])
    assert [s.x.tobytes() for s in batch] == [wanted.x.tobytes()] * 2


BAD = {
    "NaN in A": (lambda b, A, lo, up: A.__setitem__((1, 2), np.nan), "level 1, row 1: A must"),
    "infinite A": (lambda b, A, lo, up: A.__setitem__((0, 0), np.inf), "level 1, row 0: A must"),
    "huge A": (
        lambda b, A, lo, up: A.__setitem__((2, 0), 1e200),
        "level 1, row 2: a row of A must not be longer",
    ),
    "NaN in lower": (lambda b, A, lo, up: lo.__setitem__(2, np.nan), "level 1, row 2: a bound is"),
    "NaN in bounds": (lambda b, A, lo, up: b.__setitem__(1, np.nan), "level 0, row 1: a bound is"),
    "crossed": (lambda b, A, lo, up: lo.__setitem__(1, 9.0), "level 1, row 1: lower must not"),
    "crossed bounds": (lambda b, A, lo, up: b.__setitem__(0, -9.0), "level 0, row 0: lower must"),
    "lower at +inf": (
        lambda b, A, lo, up: (lo.__setitem__(0, np.inf), up.__setitem__(0, np.inf)),
        "level 1, row 0: no x can meet",
    ),
    "upper at -1e200": (
        lambda b, A, lo, up: (lo.__setitem__(0, -1e200), up.__setitem__(0, -1e200)),
        "level 1, row 0: no x can meet",
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_numbers_that_went_bad_are_found_by_the_solve(case: str) -> None:
    change, text = BAD[case]
    top, A, lower, upper = np.ones(3), np.eye(3), -np.ones(3), np.ones(3)
    levels = [rhqp.Bounds(-np.ones(3), top), rhqp.Level(A, lower, upper, 0.1)]
    solver = rhqp.Solver(3)
    assert solver.solve(levels).status == rhqp.Status.Solved
    change(top, A, lower, upper)
    with pytest.raises(hurcules.Error, match=text):
        solver.solve(levels)
    with pytest.raises(hurcules.Error, match="problem 1, " + text):
        rhqp.solve_batch([[rhqp.Bounds(-np.ones(3), np.ones(3))], levels])


def test_an_array_that_changed_its_shape_is_refused() -> None:
    A, b = np.ones((2, 3)), np.ones(2)
    level, solver = equality(A, b), rhqp.Solver(3)
    A.resize((3, 2), refcheck=False)
    with pytest.raises(hurcules.Error, match=r"level 0: A must be \(2, 3\) .* got \(3, 2\)"):
        solver.solve([level])
    A.resize((6,), refcheck=False)
    with pytest.raises(hurcules.Error, match="level 0: an array was given another shape"):
        solver.solve([level])


@pytest.mark.parametrize("size", [1e99, 1e-99, 1e-200, 1e-308])
def test_numbers_at_the_ends_of_double_have_a_truthful_status(size: float) -> None:
    """The answer is finite and within its limits; Solved comes with a proof."""
    rng = np.random.default_rng(0)
    for rho in (0.0, 0.1):
        A = size * rng.standard_normal((2, 3))
        b = np.array([1.0, -2.0])
        solution = rhqp.Solver(3).solve([rhqp.Bounds(-np.ones(3), np.ones(3)), equality(A, b, rho)])
        assert np.isfinite(solution.x).all()
        assert (np.abs(solution.x) <= 1.0 + 1e-12).all()
        assert solution.status == rhqp.Status.Solved and solution.optimality < 1e-9


def test_huge_bounds_are_absent_and_huge_targets_refused() -> None:
    goal = equality(np.eye(2), np.array([1.0, 2.0]))
    free = rhqp.Bounds(np.full(2, -1e200), np.full(2, 1e200))
    np.testing.assert_allclose(rhqp.Solver(2).solve([free, goal]).x, [1.0, 2.0])
    with pytest.raises(hurcules.Error, match="row 0: no x can meet"):
        equality(np.eye(2), np.full(2, 1e200))
