"""Who solves the points of a study: processes of this computer, or a cluster."""

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

PATIENCE = "10s"  # for a scheduler to answer
AHEAD = 10_000  # points that it is given at once


T = TypeVar("T")


def pack(whole: object) -> bytes:
    """A whole whose points are tasks, pickled with a new mark: packed twice it counts as two, and
    processes carry nothing over from one to the other, such as when to check a model next."""
    return pickle.dumps((whole, uuid4().hex))


def solved_here(
    packed: bytes,
    points: Iterable[Any],
    workers: int,
    task: Callable[[bytes, Any, int], T],
    *,
    total: int | None = None,
) -> Generator[T, None, None]:
    """Outcomes of ``points`` as they come, from ``workers`` processes; from this one if it is one.

    ``task`` solves a point of what is ``packed``, or several that are one item, of so many that a
    process will solve. ``total``: how many points, which are taken one by one; listed ones are
    counted.

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
    """Outcomes of ``points``, ``total`` of them, as they come, from the dask cluster whose
    scheduler has ``address``.

    A worker that is lost is no loss: its points are solved by another.

    Raises
    ------
    InvalidInput : no scheduler answers there
    """
    import distributed

    dask: Any = distributed

    try:
        dask.comm.get_address_host_port(address)  # of one that is none, a client waits at its end
        client = dask.Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        raise InvalidInput(
            f"cluster: no scheduler answers at {shown(address)} ({type(error).__name__}): start "
            "one with 'dask scheduler', or leave the address out to solve here"
        ) from None
    with client:
        share = total // max(1, sum(client.ncores().values()))
        how = dict(packed=packed, points=share, pure=False, retries=ATTEMPTS)

        def begun() -> Any:
            return client.map(_on_cluster, [*islice(points, AHEAD)], **how)

        running = dask.as_completed(begun(), with_results=True, loop=client.loop)
        for future, found in running:
            future.release()
            yield found
            if running.count() < AHEAD // 2:
                running.update(begun())


def _on_cluster(number: int, packed: bytes, points: int) -> Outcome:
    return solve_points(packed, (number,), points)[0]
