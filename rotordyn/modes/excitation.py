"""Excitation at multiples of the speed: the lines of a Campbell diagram."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

OF_UNBALANCE = 1.0  # the order of forces that rotate with the shaft
EITHER = "either"  # direction of rotation


class Line(NamedTuple):
    """Excitation at ``order`` times the speed of ``rotor``: ``multiple`` times the spindle's.

    A negative multiple is of a counter-rotating rotor.
    """

    rotor: str
    order: float
    multiple: float

    @property
    def name(self) -> str:
        """
        >>> Line("spindle", 0.43, 0.43).name, Line("spindle", 1.0, 1.0).name
        ('0.43×', '1×')
        """
        return f"{self.order:g}×"

    @property
    def size(self) -> float:
        """Frequency over the speed of the spindle."""
        return abs(self.multiple)

    @property
    def way(self) -> str:
        """Direction in which its rotor rotates, seen along x."""
        return "forward" if self.multiple > 0.0 else "backward"

    @property
    def other_way(self) -> str:
        """The opposite direction."""
        return "backward" if self.multiple > 0.0 else "forward"

    def excites(self, excited_by: str) -> bool:
        """Return whether it may excite a mode that unbalance in a direction (``excited_by``)
        excites; forces of another order than 1 may have any direction.

        >>> [Line("quill", 1.0, -1.5).excites(way) for way in ("forward", "backward", "either")]
        [False, True, True]
        """
        return self.order != OF_UNBALANCE or excited_by in (self.way, EITHER)


def excited_by(kind: str, whirl: str, *, axisymmetric: bool, across: bool) -> str:
    """Return the direction in which unbalance rotates that excites a mode: as a bending mode whirls
    where both planes are alike, else ``EITHER``; empty of axial motion and torsion that move no
    shaft ``across`` its axis."""
    if kind != "bending":
        return EITHER if across else ""
    return whirl if axisymmetric and whirl in ("forward", "backward") else EITHER


def exciting(ratios: Mapping[str, float], orders: Iterable[float]) -> list[Line]:
    """Return lines of ``orders`` of every rotor that rotates; of equal speeds those of the first.

    >>> [line.multiple for line in exciting({"spindle": 1.0, "sleeve": 1.0, "outer": -1.5}, [1, 2])]
    [1.0, 2.0, -1.5, -3.0]
    """
    first: dict[float, str] = {}
    for name, ratio in ratios.items():
        if ratio != 0.0:
            first.setdefault(ratio, name)
    return [Line(name, order, order * ratio) for ratio, name in first.items() for order in orders]
