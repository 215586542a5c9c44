"""Parts of a batch on threads: every item once and in order; linear algebra keeps to one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from threadpoolctl import threadpool_info, threadpool_limits

import rotordyn
from rotordyn.job.solving import restricted, solve
from rotordyn.numerics import threads
from rotordyn.numerics.modes import modes
from rotordyn.numerics.threads import in_threads, linear_algebra_alone

CASES = Path(__file__).resolve().parents[3] / "cases"


@pytest.mark.parametrize("count", [0, 1, 3, 4, 7, 49])
@pytest.mark.parametrize("processors", [1, 2, 5])
def test_every_item_once_and_in_order(
    count: int, processors: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(threads, "processors", lambda: processors)
    items = list(range(count))
    parts = in_threads(lambda part: items[part], count, least=2)
    assert [k for part in parts for k in part] == items
    assert len(parts) == max(1, min(processors, count // 2), count // threads.MOST)


def test_an_error_of_a_part_is_the_error_of_the_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(threads, "processors", lambda: 3)

    def work(part: slice) -> None:
        if part.start:
            raise ArithmeticError("of a part")

    with pytest.raises(ArithmeticError, match="of a part"):
        in_threads(work, 9, least=1)


def test_threads_change_no_bit_of_the_modes(monkeypatch: pytest.MonkeyPatch) -> None:
    draw = np.random.default_rng(5)
    stiffness = draw.normal(size=(17, 3, 3)) + 5.0 * np.eye(3)
    damping = 0.1 * draw.normal(size=(17, 3, 3))
    found = []
    for count in (1, 4):
        monkeypatch.setattr(threads, "processors", lambda count=count: count)
        found.append(modes(stiffness, damping))
    alone, together = found
    for name in ("pole", "vector", "participation", "condition"):
        assert np.array_equal(getattr(alone, name), getattr(together, name))


def blas_threads() -> list[int]:
    return [lib["num_threads"] for lib in threadpool_info() if lib["user_api"] == "blas"]


def test_linear_algebra_keeps_to_one_thread_and_is_given_back() -> None:
    before = blas_threads()
    with linear_algebra_alone():
        assert blas_threads()
        assert set(blas_threads()) == {1}
    assert blas_threads() == before


def test_a_case_is_solved_so() -> None:
    seen: set[int] = set()
    case = restricted(rotordyn.load(CASES / "lalanne_ferraris.yaml"), ("campbell",))
    with threadpool_limits(2, "blas"):
        solve(case, lambda name: seen.update(blas_threads()))
    assert seen == {1}
