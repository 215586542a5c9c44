"""Warning about peaks of nearly undamped modes, whose height means nothing."""

from __future__ import annotations

LIGHT = 1e-5  # damping ratio; steel alone has ten times that


def lightly_damped(peak: str, mode: str, ratio: float) -> str:
    """Return a warning about the highest ``peak`` of a response, set by a ``mode`` of such a
    damping ``ratio``.

    >>> lightly_damped("frf: the highest peak of a", "bending 1", 3e-7)[:74]
    'frf: the highest peak of a is set by bending 1, which has a damping ratio '
    """
    has = f"has a damping ratio of {ratio:.0e} only" if ratio > 0.0 else "has no damping"
    return (
        f"{peak} is set by {mode}, which {has}, so that its height is meaningless: give damping of "
        "the bearings or supports in which that mode moves, or damping.rotor"
    )
