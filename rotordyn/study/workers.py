"""Distribute the points of a study over processes of this computer, or over a cluster."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Generator, Iterable, Iterator
from itertools import islice
from typing import Any, TypeVar
from uuid import uuid4

from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.study.point import Outcome, solve_points
from rotordyn.study.processes import ATTEMPTS, side_by_side

PATIENCE = "10s"  # time for a scheduler to answer
AHEAD = 10_000  # points submitted to it at once


T = TypeVar("T")


def pack(whole: object) -> bytes:
    """Pickle a study together with a new identifier: if packed twice it counts as two studies, so
    that processes carry no state over, such as when to check a model next."""
    return pickle.dumps((whole, uuid4().hex))


def solved_here(
    packed: bytes,
    points: Iterable[Any],
    workers: int,
    task: Callable[[bytes, Any, int], T],
    *,
    total: int | None = None,
) -> Generator[T, None, None]:
    """Yield outcomes of ``points`` as they come from ``workers`` processes (1: this one).

    ``task`` takes ``packed``, an item of ``points`` (one point, or several), and the number of
    points that a process will solve. ``total``: number of points, taken from ``points`` one by one;
    if None they are listed and counted.

    Raises
    ------
    RotordynError : processes were killed again and again, as happens where memory runs out
    """
    if total is None:
        points = [*points]
        total = len(points)
    if workers == 1 or total < 2:
        yield from (task(packed, number, total) for number in points)
        return
    count = min(workers, total)
    share = total // workers
    yield from side_by_side(count, ((task, (packed, point, share)) for point in points))


def solved_on_cluster(
    packed: bytes, points: Iterator[int], address: str, total: int
) -> Iterator[Outcome]:
    """Yield outcomes of ``total`` points as they come from the dask cluster whose scheduler has
    ``address``.

    Points of a lost worker are solved by another.

    Raises
    ------
    InvalidInput : no scheduler answers at the address
    """
    import distributed

    dask: Any = distributed

    try:
        dask.comm.get_address_host_port(address)  # of an invalid address, Client would time out
        client = dask.Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        raise InvalidInput(
            f"cluster: no scheduler answers at {shown(address)} ({type(error).__name__}): start "
            "one with 'dask scheduler', or leave the address out to solve here"
        ) from None
    with client:
        share = total // max(1, sum(client.ncores().values()))
        options = dict(packed=packed, points=share, pure=False, retries=ATTEMPTS)

        def submitted() -> Any:
            return client.map(_on_cluster, [*islice(points, AHEAD)], **options)

        running = dask.as_completed(submitted(), with_results=True, loop=client.loop)
        for future, outcome in running:
            future.release()
            yield outcome
            if running.count() < AHEAD // 2:
                running.update(submitted())


def _on_cluster(number: int, packed: bytes, points: int) -> Outcome:
    return solve_points(packed, (number,), points)[0]
