"""Joints of a shaft: springs and dampers between the part in front of a node and that behind.

Theory: docs/theory/shaft.md#joints.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from rotordyn.arrays import Array
from rotordyn.equation.shaft import WAYS, Shaft
from rotordyn.equation.term import Part


def joint_parts(shaft: Shaft) -> Iterator[Part]:
    """Yield springs, and dampers, which rotate with their rotor."""
    for joint in shaft.spindle.joints:
        node = shaft.mesh.node_of(joint.x)
        for kind, directions in WAYS.items():
            stiffness, damping = getattr(joint, kind), getattr(joint, f"{kind}_damping")
            if math.isinf(stiffness):
                continue
            for name in directions:
                rows = np.array([[shaft.jump[node, name]]])
                yield Part("stiffness", rows, rows, _one(stiffness))
                if damping:
                    yield Part("damping", rows, rows, _one(damping))
                    if name not in ("x", "thx"):
                        yield Part("turning", rows, rows, _one(shaft.ratio * damping))


def _one(value: float) -> Array:
    return np.full((1, 1, 1), value)
