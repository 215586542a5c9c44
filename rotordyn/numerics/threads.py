"""Independent parts of a batch on as many threads as there are processors.

It helps where the work of a part is done inside compiled routines, which let other threads go on.
Their own threads do not: on matrices of this size they wait for one another, on a busy machine ten
times longer than they work.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController

S = TypeVar("S")
T = TypeVar("T")
MOST = 16  # items of a slice
_processes = [1]


def linear_algebra_alone() -> AbstractContextManager[object]:
    """Return a context with linear algebra on one thread per call, however many processors."""
    return _pools(len(sys.modules)).limit(limits=1, user_api="blas")


@lru_cache(maxsize=1)
def _pools(modules: int) -> ThreadpoolController:
    """Return the libraries loaded with this number of ``modules``; a search takes a millisecond."""
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()


def processors() -> int:
    """Return the number of processors this process may use."""
    has_affinity = hasattr(os, "sched_getaffinity")
    return max(
        1, (len(os.sched_getaffinity(0)) if has_affinity else os.cpu_count() or 1) // _processes[0]
    )


def side_by_side(processes: int) -> None:
    """Share processors among this number of ``processes``, this one included."""
    _processes[0] = processes


def in_threads(work: Callable[[slice], T], count: int, least: int) -> list[T]:
    """Run ``work`` on consecutive slices of ``count`` items, in order; none smaller than ``least``.

    None is much larger than ``MOST``: Ctrl-C waits for those in progress.
    """
    threads = max(1, min(processors(), count // least))
    parts = max(threads, min(count // MOST, count // least))
    ends = pairwise(count * k // parts for k in range(parts + 1))
    return list(each_in_threads(work, [slice(*bounds) for bounds in ends], threads))


def each_in_threads(
    work: Callable[[S], T], items: Sequence[S], threads: int | None = None
) -> Iterator[T]:
    """Run ``work`` on every item, in order; on as many threads as there are processors by default.

    Where one fails, or Ctrl-C comes, no further item is started.
    """
    threads = threads or processors()
    if threads == 1:
        yield from map(work, items)
        return
    with ThreadPoolExecutor(threads) as pool:
        try:
            yield from pool.map(work, items)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
