"""Degrees of freedom by name: six of every node, and those that terms add.

A DOF belongs to a ``Line``: what moves (a rotor, a sleeve, a housing) and its direction. Rotations
thy count from z to −x: z and −thy obey the same equations as y and thz, so that every matrix of
a shaft in plane z is that of plane y if DOF thy are taken with a sign of −1 (``Dofs.sign``).
With r = y + i z and φ = thz − i thy both planes are one complex plane.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Indices

DIRECTIONS = ("x", "y", "z", "thx", "thy", "thz")
PLANE_OF = {"y": "y", "thz": "y", "z": "z", "thy": "z"}  # bending plane of each direction


class Line(NamedTuple):
    """DOF of one ``body`` that move in one direction ``way``: "x", "thx", the bending planes "y"
    and "z", or "" of coordinates without one."""

    body: str
    way: str

    @property
    def kind(self) -> str:
        """ "axial", "torsion", "bending", or "" of coordinates without a direction."""
        return {"x": "axial", "thx": "torsion", "y": "bending", "z": "bending"}.get(self.way, "")


class Dofs:
    """All DOF of a machine, numbered as terms add them; signs (DOF,) of thy are −1, others 1."""

    def __init__(self) -> None:
        self.lines: list[Line] = []
        self._line: list[Indices] = []
        self._sign: list[Array] = []
        self.count = 0

    def add(self, body: str, directions: Sequence[str], times: int = 1) -> Indices:
        """Add DOF of a body, "" without a direction; return their numbers (times, directions)."""
        lines = [Line(body, PLANE_OF.get(name, name)) for name in directions]
        self.lines += [line for line in dict.fromkeys(lines) if line not in self.lines]
        self._line.append(np.tile([self.lines.index(line) for line in lines], times))
        signs = [-1.0 if name == "thy" else 1.0 for name in directions]
        self._sign.append(np.tile(signs, times))
        first, self.count = self.count, self.count + times * len(directions)
        return np.arange(first, self.count).reshape(times, len(directions))

    @property
    def line(self) -> Indices:
        """Index in ``lines`` of every DOF (DOF,)."""
        return np.concatenate(self._line)

    @property
    def sign(self) -> Array:
        """Sign of every DOF (DOF,)."""
        return np.concatenate(self._sign)


def position(direction: str) -> int:
    """Return the index of a direction among the six of a node.

    Raises
    ------
    ValueError : there is no such direction
    """
    if direction not in DIRECTIONS:
        raise ValueError(f"no direction {direction!r}: one of {', '.join(DIRECTIONS)}")
    return DIRECTIONS.index(direction)
