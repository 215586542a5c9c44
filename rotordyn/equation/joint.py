"""Joints of a shaft: springs and dampers between the part in front of a node and that behind.

Theory: docs/theory/shaft.md#joints.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from rotordyn.equation.shaft import WAYS, Shaft
from rotordyn.equation.term import Part


def joint_parts(shaft: Shaft) -> Iterator[Part]:
    """Springs; dampers, which turn with their rotor."""
    for joint in shaft.spindle.joints:
        at = shaft.mesh.node_of(joint.x)
        for way, directions in WAYS.items():
            stiffness, damping = getattr(joint, way), getattr(joint, f"{way}_damping")
            if math.isinf(stiffness):
                continue
            for name in directions:
                rows, one = np.array([[shaft.jump[at, name]]]), np.ones((1, 1, 1))
                yield Part("stiffness", rows, rows, stiffness * one)
                if damping:
                    yield Part("damping", rows, rows, damping * one)
                    if name not in ("x", "thx"):
                        yield Part("turning", rows, rows, shaft.ratio * damping * one)
