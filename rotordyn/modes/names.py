"""Names of followed modes, and the order in which they are listed."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from rotordyn.modes.branches import Branch


def named(branches: Iterable[Branch]) -> tuple[list[Branch], tuple[str, ...]]:
    """Return branches as they are listed, and their names: numbered from below, by kind."""
    listed = sorted(branches, key=_rank)
    return listed, _names(listed)


def _rank(branch: Branch) -> tuple[str, bool, float, float]:
    """Rank bending, axial, torsion; overdamped last; from below; of equal ones backward first."""
    kind = {"bending": "0", "axial": "1", "torsion": "2"}[branch.kind]
    first = branch.first_row
    return (
        kind,
        branch.overdamped,
        float(f"{branch.frequency[first]:.8g}"),
        float(branch.whirl[first]),
    )


def _names(branches: list[Branch]) -> tuple[str, ...]:
    """Number the modes of each kind (and whirl, where it is one throughout) from below."""
    counts: dict[str, int] = {}
    names = []
    paired = all(np.unique(b.whirl[b.column >= 0]).size == 1 for b in branches)
    for branch in branches:
        whirl = {1.0: " forward", -1.0: " backward"}.get(float(branch.whirl[branch.first_row]), "")
        family = branch.kind + (whirl if paired else "")
        counts[family] = counts.get(family, 0) + 1
        names.append(f"{branch.kind} {counts[family]}{whirl if paired else ''}")
    return tuple(names)
