"""Point masses and discs: rigid bodies on one node.

Theory: docs/theory/shaft.md#masses-and-discs.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.equation.dofs import position
from rotordyn.equation.shaft import PLANES, Shaft
from rotordyn.equation.term import Part


def lumped_parts(shaft: Shaft) -> Iterator[Part]:
    """Yield mass, inertia and gyroscopic effect of bodies on a shaft; at a joint in front of it."""
    bodies = shaft.spindle.lumped
    if not bodies:
        return
    nodes = shaft.node[[shaft.mesh.node_of(body.x) for body in bodies]]
    mass = np.array([body.mass for body in bodies])
    polar = np.array([body.polar_inertia for body in bodies])
    diametral = np.array([body.diametral_inertia for body in bodies])
    zero = np.zeros_like(mass)
    for direction, inertia in (("x", mass), ("thx", polar)):
        rows = nodes[:, [position(direction)]]
        yield Part("mass", rows, rows, inertia[:, None, None])
    planes = {w: nodes[:, [position(name) for name in names]] for w, (names, _) in PLANES.items()}
    for rows in planes.values():
        yield Part("mass", rows, rows, _diagonal(mass, diametral))
        yield Part("softening", rows, rows, _diagonal(mass, zero))
    yield Part("gyroscopic", planes["y"], planes["z"], shaft.ratio * _diagonal(zero, polar))


def _diagonal(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Return diagonal blocks (bodies, 2, 2)."""
    return np.stack([first, second], axis=1)[:, :, None] * np.eye(2)
