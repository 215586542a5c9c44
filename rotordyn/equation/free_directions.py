"""Motions of a subsystem that nothing holds: counted by what joins its bodies, not by how stiff
that is."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from rotordyn.arrays import Array
from rotordyn.equation.connection import Connection, at_rows
from rotordyn.equation.constraint import DEPENDENT
from rotordyn.equation.linear import Linear
from rotordyn.numerics.modes import NOTHING


def free_directions(linear: Linear, rows: Iterable[int]) -> list[int]:
    """How many motions nothing holds at some of the speeds.

    They strain no body, and no link answers them, whatever its stiffness, unless that is
    ``NOTHING`` beside the largest; the axial force does not count.
    """
    if not (rows := list(rows)):
        return []
    still, moved, sizes, answered = _unstrained(linear), [], [], False
    for each in linear.connections:
        relative, size = each.motions @ still, np.linalg.norm(each.motions, axis=1)
        sizes.append(np.outer(size, size))
        relative[np.linalg.norm(relative, axis=1) <= DEPENDENT * size] = 0.0
        answered |= bool(each.link.rigid) or bool((each.matrices.stiffness @ relative).any())
        moved.append(_of_unit_rows(relative))
    if not answered:  # most shafts turn freely
        return [still.shape[1]] * len(rows)
    known: dict[bytes, int] = {}  # which entries are zero is the same at most speeds
    counts = []
    for row in rows:
        held = [at_rows(c.matrices.stiffness, np.array([row]))[0] for c in linear.connections]
        least = NOTHING * np.abs(linear.stiffness[row]).max(initial=0.0)
        held = [
            np.where(np.abs(matrix) * size < least, 0.0, matrix)
            for matrix, size in zip(held, sizes, strict=True)
        ]
        key = b"".join((matrix != 0.0).tobytes() for matrix in held)
        if key not in known:
            answers = [np.zeros((1, still.shape[1]))]
            for each, matrix, relative in zip(linear.connections, held, moved, strict=True):
                answers.append((_of_unit(matrix) + np.diag(each.rigid)) @ relative)
            rank = int(np.linalg.matrix_rank(np.concatenate(answers), DEPENDENT))
            known[key] = still.shape[1] - rank
        counts.append(known[key])
    return counts


def _unstrained(linear: Linear) -> Array:
    """Motions that strain no body (n, k)."""
    motions = [np.zeros((linear.size, 0))]
    for component, at in zip(linear.components, linear.slices, strict=True):
        values, vectors = np.linalg.eigh(component.stiffness)
        free = vectors[:, values <= DEPENDENT**2 * np.abs(values).max(initial=0.0)]
        motions.append(np.zeros((linear.size, free.shape[1])))
        motions[-1][at] = free
    return np.hstack(motions)


def too_stiff(linear: Linear) -> str:
    """A sentence about the stiffest link."""

    def largest(each: Connection) -> float:
        return float(np.abs(each.stiffness).max())

    stiffest = max(linear.connections, key=largest)
    return (
        f"'{stiffest.link.name}' is so stiff, {np.abs(stiffest.matrices.stiffness).max():.0e} "
        "N/m, that slow motions beside it are lost in rounding: hold it rigid, or lower its "
        "stiffness"
    )


def _of_unit(matrix: Array) -> Array:
    """A matrix (n, n) with rows and columns in their own measure."""
    size = np.abs(matrix)
    scale = np.sqrt(np.maximum(size.max(axis=0), size.max(axis=1)))
    scale = np.where(scale > 0.0, scale, 1.0)
    return np.asarray(matrix / scale[:, None] / scale)


def _of_unit_rows(rows: Array) -> Array:
    """Rows (k, n) of length 1, or 0."""
    size = np.linalg.norm(rows, axis=1, keepdims=True)
    return np.asarray(rows / np.where(size > 0.0, size, 1.0))
