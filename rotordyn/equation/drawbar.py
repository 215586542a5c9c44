"""The drawbar as a string under tension P, straight between stations where it touches the shaft.

Over a distance L its stiffness against their relative deflection is P/L.

Theory: docs/theory/axial_force.md#the-drawbar.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import pairwise

import numpy as np

from rotordyn.equation.dofs import position
from rotordyn.equation.shaft import Shaft
from rotordyn.equation.term import Link, LinkMatrices, State


def drawbar_links(shaft: Shaft) -> Iterator[Link]:
    """Yield a link for every straight part."""
    bar = shaft.spindle.drawbar
    for a, b in pairwise(bar.contacts if bar else ()):
        assert bar is not None
        ends = shaft.node[[shaft.mesh.node_of(a), shaft.mesh.node_of(b)]]
        dofs = ends[:, [position("y"), position("z")]].ravel()
        motions = np.array([[-1.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 1.0]])
        matrices = LinkMatrices(bar.force / (b - a) * np.eye(2)[None], np.zeros((1, 2, 2)))
        yield Link("drawbar", dofs, motions, partial(_always, matrices))


def _always(matrices: LinkMatrices, _: State) -> LinkMatrices:
    return matrices
