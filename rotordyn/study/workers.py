"""Who solves the points of a study: processes of this computer, or a cluster."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, Protocol, TypeVar

from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.study.point import Outcome, solve_point
from rotordyn.study.processes import ATTEMPTS, side_by_side

PATIENCE = "10s"  # for a scheduler to answer


class Numbered(Protocol):
    """What a point came to, which knows its ``number``."""

    @property
    def number(self) -> Any: ...


N = TypeVar("N", bound=Numbered)


def solved_here(
    packed: bytes,
    points: Sequence[Any],
    workers: int,
    task: Callable[[bytes, Any, int], N] = solve_point,  # type: ignore[assignment]
) -> Iterator[N]:
    """Outcomes of ``points`` as they come, from ``workers`` processes; from this one if it is one.

    ``task`` solves one of the points of what is ``packed``, of so many that a process will solve.

    Raises
    ------
    RotordynError : processes were killed again and again, as happens where memory runs out
    """
    if workers == 1 or len(points) < 2:
        yield from (task(packed, number, len(points)) for number in points)
        return
    count = min(workers, len(points))
    share = len(points) // workers
    yield from side_by_side(count, ((task, (packed, point, share)) for point in points))


def solved_on_cluster(packed: bytes, points: Sequence[int], address: str) -> Iterator[Outcome]:
    """Outcomes of ``points`` as they come, from the dask cluster whose scheduler has ``address``.

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
        share = len(points) // max(1, sum(client.ncores().values()))
        how = dict(packed=packed, points=share, pure=False, retries=ATTEMPTS)
        futures = client.map(_on_cluster, points, **how)
        running = dask.as_completed(futures, with_results=True, loop=client.loop)
        for future, found in running:
            future.release()
            yield found


def _on_cluster(number: int, packed: bytes, points: int) -> Outcome:
    return solve_point(packed, number, points)
