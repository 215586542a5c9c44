"""Entries of stiffness and damping matrices by pair of DOF: names, ranges, symmetry."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import chain, product
from typing import Annotated, Any

from rotordyn.errors import InvalidInput
from rotordyn.quantity import Choice, Quantity, suggestion
from rotordyn.units import shown

DOFS = ("x", "y", "z", "thx", "thy", "thz")
Dof = Annotated[str, Choice(DOFS)]
Value = float | tuple[float, ...]
Entries = Mapping[tuple[Dof, Dof], Value]
WHOLE = ("dof", "matrix")  # keys of a complete matrix
SYMMETRIC = 1e-9  # of an entry: less than that is rounding
MOST = {"stiffness": 1e20, "damping": 1e13}  # [SI] of any entry: beyond, rounding dominates
_UNITS = {"stiffness": ("N/m", "N/rad", "N m/rad"), "damping": ("N s/m", "N s/rad", "N m s/rad")}


@dataclass(frozen=True, slots=True)
class Matrix:
    """Marks entries of a 6×6 ``"stiffness"`` or ``"damping"`` matrix by pair (load, displacement).

    Files write them by name (``yy``, ``y_thz``), or as a matrix with the DOF of its rows and
    columns; Python also as 6 × 6 numbers, or lists of them over the speeds of a table.
    """

    kind: str

    def meant(self, value: object) -> object:
        """Return the entries by pair.

        >>> STIFFNESS.meant({"yy": "50 N/um", ("z", "z"): 4e7})
        {('y', 'y'): 50000000.0, ('z', 'z'): 40000000.0}
        >>> DAMPING.meant({"dof": ["y", "thz"], "matrix": [[8.0, 0.0], [1.0, 3.0]]})
        {('y', 'y'): 8.0, ('thz', 'y'): 1.0, ('thz', 'thz'): 3.0}
        """
        if isinstance(value, Mapping) and set(value) == {*WHOLE}:
            entries = _whole(dofs_of(value["dof"]), value["matrix"])
        elif isinstance(value, Mapping):
            entries = {_pair(key): entry for key, entry in value.items()}
            if len(entries) < len(value):
                raise InvalidInput("an entry is given twice: allowed: once, by name or by pair")
        elif isinstance(value, list | tuple) or getattr(value, "ndim", 0) > 0:
            entries = _whole(DOFS, value)
        else:
            return value
        return {pair: self._read(pair, entry) for pair, entry in entries.items()}

    def _read(self, pair: Any, value: object) -> object:
        if isinstance(value, list | tuple):
            return [self._read(pair, item) for item in value]
        return self.quantity(*pair).read(value) if isinstance(value, str) else value

    def quantity(self, row: str, column: str) -> Quantity:
        """Return the range of an entry, by how many of its two DOF are rotations."""
        return _entry(self.kind, sum(len(dof) > 1 for dof in (row, column)))

    def refusal(self, entries: Entries) -> str:
        """Return why an entry is refused; empty where all are allowed."""
        for pair, value in entries.items():
            quantity = self.quantity(*pair)
            for number in value if isinstance(value, tuple) else (value,):
                if why := quantity.refusal(number):
                    return f"{entry_name(*pair)}: {why}"
        return ""


@cache
def _entry(kind: str, rotations: int) -> Quantity:
    names, limit = (kind, f"coupling {kind}", f"tilt {kind}"), f"{MOST[kind]:g}"
    bound = f"{limit} {_UNITS[kind][rotations]}"
    instead = ", or rigid: no displacement" if kind == "stiffness" else ""
    return Quantity(names[rotations], at_least=f"-{bound}", at_most=bound, instead=instead)


def _pair(key: Any) -> Any:
    if isinstance(key, str) and key not in ENTRIES:
        raise InvalidInput(
            f"unknown entry: given '{key}'; allowed: two of {', '.join(DOFS)}, as yy or y_thz"
            f"{suggestion(key, ENTRIES)}"
        )
    return ENTRIES[key] if isinstance(key, str) else key


def dofs_of(given: Any) -> tuple[str, ...]:
    """Return the DOF of rows and columns; raises InvalidInput."""
    dofs = tuple(map(str, given)) if isinstance(given, list | tuple) else ()
    if not dofs or len({*dofs}) < len(dofs) or not {*dofs} <= {*DOFS}:
        raise InvalidInput(
            f"not DOF: given {shown(', '.join(dofs) or given)}; allowed: different ones of "
            f"{', '.join(DOFS)}"
        )
    return dofs


def _whole(dofs: Sequence[str], matrix: Any) -> dict[tuple[str, str], Any]:
    """Return the nonzero entries of rows of numbers."""
    rows = rows_of(matrix, len(dofs))
    pairs = zip(product(dofs, dofs), map(_plain, chain(*rows)), strict=True)
    return {pair: number for pair, number in pairs if acts(number)}


def rows_of(matrix: Any, size: int) -> list[Any]:
    """Return the rows of a square matrix of this size; raises InvalidInput."""
    given = _plain(matrix)
    rows = [_plain(row) for row in given] if isinstance(given, list | tuple) else []
    lengths = [len(row) if isinstance(row, list | tuple) else 0 for row in rows]
    if lengths != [size] * size:
        count = f"{len(rows)} rows of {', '.join(map(str, lengths))}" if rows else shown(given)
        raise InvalidInput(
            f"not a matrix of its DOF: given {count}; allowed: {size} rows of {size}"
        )
    return rows


def _plain(value: Any) -> Any:
    """Return arrays as lists."""
    return value.tolist() if hasattr(value, "tolist") else value


STIFFNESS, DAMPING = Matrix("stiffness"), Matrix("damping")


def entry_name(row: str, column: str) -> str:
    """Return the name of an entry of a 6×6 matrix in files: ``yy``, ``y_thz``."""
    return row + column if len(row) == len(column) == 1 else f"{row}_{column}"


ENTRIES = {entry_name(row, column): (row, column) for row, column in product(DOFS, DOFS)}


def acts(value: Value | list[float]) -> bool:
    """Return whether an entry is nonzero at some speed."""
    return any(value) if isinstance(value, list | tuple) else value != 0.0


def no_spring(stiffness: Entries) -> Iterator[str]:
    """Yield a sentence where a loss factor has no symmetric, positive semidefinite stiffness."""
    if not any(acts(value) for value in stiffness.values()):
        yield "loss_factor needs a stiffness: none is given"
        return
    rows = max(len(value) if isinstance(value, tuple) else 1 for value in stiffness.values())
    for k in range(rows):
        entries = {p: v[k] if isinstance(v, tuple) else v for p, v in stiffness.items()}
        for (row, column), value in entries.items():
            other = entries.get((column, row), 0.0)
            if abs(value - other) > SYMMETRIC * max(abs(value), abs(other)):
                yield (
                    f"loss_factor needs a symmetric stiffness: given {entry_name(row, column)} "
                    f"{value:.6g} and {entry_name(column, row)} {other:.6g}"
                )
                return
        if not _resists(entries):
            yield "loss_factor needs a positive semidefinite stiffness"
            return


def _resists(entries: Mapping[tuple[str, str], float]) -> bool:
    """Return whether a symmetric matrix, scaled by its diagonal, is positive semidefinite."""
    import numpy as np

    names = list(dict.fromkeys(row for row, _ in entries))
    size = {name: entries.get((name, name), 0.0) for name in names}
    if any(size[r] <= 0.0 or size[c] <= 0.0 for (r, c), v in entries.items() if v != 0.0):
        return False
    stiff = [name for name in names if size[name] > 0.0]
    rows = [[entries.get((r, c), 0.0) / math.sqrt(size[r] * size[c]) for c in stiff] for r in stiff]
    return not stiff or bool(np.linalg.eigvalsh(rows)[0] >= -SYMMETRIC)
