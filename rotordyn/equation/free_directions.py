"""Free motions of a subsystem, counted by the links of its bodies, not by their stiffness."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array, Indices
from rotordyn.equation.connection import Connection, at_rows
from rotordyn.equation.constraint import DEPENDENT
from rotordyn.equation.linear import Linear
from rotordyn.numerics.modes import NOTHING


def free_directions(linear: Linear, rows: Indices) -> Indices:
    """Return the number of free motions at some of the speeds.

    They strain no body, and no link resists them, whatever its stiffness, unless that is less than
    ``NOTHING`` of the largest; the axial force does not count.
    """
    unstrained = _unstrained(linear)
    least = NOTHING * np.abs(linear.stiffness[rows]).max(axis=(1, 2), initial=0.0)[:, None, None]
    resistances = [np.zeros((len(rows), 1, unstrained.shape[1]))]
    for c in linear.connections:
        relative, size = c.motions @ unstrained, np.linalg.norm(c.motions, axis=1)
        relative[np.linalg.norm(relative, axis=1) <= DEPENDENT * size] = 0.0
        stiffness = at_rows(c.matrices.stiffness, rows)
        stiffness = np.where(np.abs(stiffness) * np.outer(size, size) < least, 0.0, stiffness)
        resistances.append((_scaled(stiffness) + np.diag(c.rigid)) @ _unit_rows(relative))
    rank = np.linalg.matrix_rank(np.concatenate(resistances, axis=1), DEPENDENT)
    return np.asarray(unstrained.shape[1] - rank)


def _unstrained(linear: Linear) -> Array:
    """Return the motions that strain no body (n, k)."""
    motions = [np.zeros((linear.size, 0))]
    for component, at in zip(linear.components, linear.slices, strict=True):
        values, vectors = np.linalg.eigh(component.stiffness)
        free = vectors[:, values <= DEPENDENT**2 * np.abs(values).max(initial=0.0)]
        motions.append(np.zeros((linear.size, free.shape[1])))
        motions[-1][at] = free
    return np.hstack(motions)


def too_stiff(linear: Linear) -> str:
    """Return a sentence about the stiffest link."""

    def largest(connection: Connection) -> float:
        return float(np.abs(connection.stiffness).max())

    stiffest = max(linear.connections, key=largest)
    return (
        f"'{stiffest.link.name}' is so stiff, {np.abs(stiffest.matrices.stiffness).max():.0e} N/m, "
        "that rounding hides slow motions: make it rigid, or lower its stiffness"
    )


def _scaled(matrix: Array) -> Array:
    """Return matrices (…, n, n) with rows and columns scaled by their size."""
    size = np.abs(matrix)
    scale = np.sqrt(np.maximum(size.max(axis=-2), size.max(axis=-1)))
    scale = np.where(scale > 0.0, scale, 1.0)
    return np.asarray(matrix / scale[..., :, None] / scale[..., None, :])


def _unit_rows(rows: Array) -> Array:
    """Return rows (k, n) scaled to length 1, or 0."""
    size = np.linalg.norm(rows, axis=1, keepdims=True)
    return np.asarray(rows / np.where(size > 0.0, size, 1.0))
