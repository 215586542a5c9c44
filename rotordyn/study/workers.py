"""Who solves the points of a study: processes of this computer, or a cluster."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import Any

from rotordyn.errors import InvalidInput, RotordynError
from rotordyn.field import shown
from rotordyn.numerics.threads import side_by_side
from rotordyn.study.point import Outcome, solve_point

ATTEMPTS = 3  # at points whose process was killed
PATIENCE = "10s"  # for a scheduler to answer


def solved_here(packed: bytes, points: Sequence[int], workers: int) -> Iterator[Outcome]:
    """Outcomes of ``points`` as they come, from ``workers`` processes; from this one if it is one.

    Raises
    ------
    RotordynError : processes were killed again and again, as happens where memory runs out
    """
    if workers == 1 or len(points) < 2:
        yield from (solve_point(packed, number, len(points)) for number in points)
        return
    from joblib import Parallel, delayed
    from joblib.externals.loky.process_executor import TerminatedWorkerError

    left = dict.fromkeys(points)
    for _ in range(ATTEMPTS):
        pool = Parallel(n_jobs=min(workers, len(left)), return_as="generator_unordered")
        with suppress(TerminatedWorkerError):
            for found in pool(delayed(_beside)(packed, k, workers, len(left)) for k in list(left)):
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


def _beside(packed: bytes, number: int, workers: int, points: int) -> Outcome:
    side_by_side(workers)
    return solve_point(packed, number, points // workers)


def _on_cluster(number: int, packed: bytes, points: int) -> Outcome:
    return solve_point(packed, number, points)
