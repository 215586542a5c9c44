"""The freedoms of one node, in the order of every 6×6 and 12×12 matrix of this package."""

from __future__ import annotations

FREEDOMS = ("x", "y", "z", "thx", "thy", "thz")


def position(freedom: str) -> int:
    """Row of a freedom in a node's 6×6 matrix.

    Raises
    ------
    ValueError : there is no freedom of that name
    """
    return place_of(freedom, FREEDOMS)


def place_of(freedom: str, freedoms: tuple[str, ...]) -> int:
    """Place of a freedom in an order of them.

    Raises
    ------
    ValueError : it is not among them
    """
    if freedom not in freedoms:
        raise ValueError(f"no freedom {freedom!r}: one of {', '.join(freedoms)}")
    return freedoms.index(freedom)
