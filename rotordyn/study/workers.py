"""Who solves the points of a study: processes of this computer, or a cluster."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from typing import Any, Protocol, TypeVar

from rotordyn.errors import InvalidInput, RotordynError
from rotordyn.field import shown
from rotordyn.numerics.threads import side_by_side
from rotordyn.study.point import Outcome, solve_point

ATTEMPTS = 3  # at points whose process was killed
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
    from joblib import Parallel, delayed
    from joblib.externals.loky.process_executor import TerminatedWorkerError

    left = dict.fromkeys(points)
    for _ in range(ATTEMPTS):
        pool = Parallel(n_jobs=min(workers, len(left)), return_as="generator_unordered")
        with suppress(TerminatedWorkerError):
            share = len(left) // workers
            calls = (delayed(_beside)(task, packed, k, workers, share) for k in list(left))
            for found in pool(calls):
                del left[found.number]
                yield found
            return
    raise RotordynError(
        f"processes were killed while they solved, {len(left)} points are left: is there enough "
        "memory? take fewer workers"
    )


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
        study = client.scatter(packed, broadcast=True, hash=False)
        share = len(points) // max(1, sum(client.ncores().values()))
        how = dict(packed=study, points=share, pure=False, retries=ATTEMPTS)
        futures = client.map(_on_cluster, points, **how)
        running = dask.as_completed(futures, with_results=True, loop=client.loop)
        for future, found in running:
            future.release()
            yield found


def _beside(
    task: Callable[[bytes, Any, int], N], packed: bytes, point: Any, workers: int, share: int
) -> N:
    side_by_side(workers)
    return task(packed, point, share)


def _on_cluster(number: int, packed: bytes, points: int) -> Outcome:
    return solve_point(packed, number, points)
