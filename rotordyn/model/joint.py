"""Joints of a shaft: springs and dampers between the part in front of a node and that behind."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from rotordyn.model.dofs import position
from rotordyn.model.shaft import WAYS, Shaft
from rotordyn.model.term import Part

_RELATIVE = np.array([[[1.0, -1.0], [-1.0, 1.0]]])


def joint_parts(shaft: Shaft) -> Iterator[Part]:
    """Springs; dampers, which turn with their rotor."""
    for joint in shaft.spindle.joints:
        at = shaft.mesh.node_of(joint.x)
        for way, directions in WAYS.items():
            stiffness, damping = getattr(joint, way), getattr(joint, f"{way}_damping")
            if math.isinf(stiffness):
                continue
            for name in directions:
                place = position(name)
                rows = np.array([[shaft.node[at, place], shaft.behind[at, place]]])
                yield Part("stiffness", rows, rows, stiffness * _RELATIVE)
                if damping:
                    yield Part("damping", rows, rows, damping * _RELATIVE)
                    if name not in ("x", "thx"):
                        yield Part("turning", rows, rows, shaft.ratio * damping * _RELATIVE)
