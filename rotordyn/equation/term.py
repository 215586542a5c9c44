"""Contract of a term of the equation of motion.

    M q̈ + (C + Ω G) q̇ + (K + Ω N − Ω² S) q = f

1. A term is built from its description (``rotordyn.machine``) and numbers the DOF that it adds.
2. ``parts``: constant matrices, blocks on DOF: "mass", "stiffness", "damping"; "gyroscopic" (per
   unit of the spindle's speed, rows in plane y, columns in plane z: G is that and minus its
   transpose); "turning", damping in the frame of its rotor times the speed ratio (also counted in
   "damping"; N couples the planes by it); "softening", S of fixed-frame softening.
3. ``links``: springs and dampers between DOF whose matrices follow the speed, the bearings' state
   or the axial force: they join bodies, and do not take part in the reduction of a body, which
   keeps a static mode for each DOF that a link touches.
4. Matrices are of the signed DOF of ``dofs``.

To add a term: a file like ``lumped`` (parts) or ``support`` (links), and one line in ``structure``,
for a connection of a shaft its ``LinkLaw`` in the table ``LAWS``.

Theory: docs/theory/rotor.md#parts-and-links.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import NamedTuple

from rotordyn.arrays import Array, Flags, Indices
from rotordyn.machine.support import GROUND, SPINDLE


class Part(NamedTuple):
    """Blocks (e, r, c) of a ``matrix`` at DOF ``rows`` (e, r) and ``columns`` (e, c)."""

    matrix: str
    rows: Indices
    columns: Indices
    blocks: Array


class State(NamedTuple):
    """State for links: ``speed`` (s,) [rad/s]; ``tangents`` (s, seats, 6, 6) of the bearings in the
    spindle's frame; sleeves at ``stops``, or held by friction (s, sleeves). ``standing``: loads are
    static. ``whirl``: speed of the whirl in squeeze films over that of the spindle."""

    speed: Array
    tangents: Array
    stops: Flags
    standing: bool = False
    whirl: float = 1.0


class LinkMatrices(NamedTuple):
    """Stiffness and damping (s or 1, k, k) of a link over its relative motions."""

    stiffness: Array
    damping: Array


AtState = Callable[[State], LinkMatrices]


class LinkLaw(NamedTuple):
    """The link that a bearing, support or damper is between two ``ends``, rotors or ground:
    ``matrices`` over the six directions, ``loss_factor`` and ``rigid`` as of a ``Link``; ``acts``:
    the directions in which it does."""

    matrices: AtState
    acts: Iterable[str]
    ends: tuple[str, str] = (SPINDLE, GROUND)
    loss_factor: float = 0.0
    rigid: tuple[int, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class Link:
    """Springs and dampers over k relative motions d = ``motions`` (k, DOF) q[``dofs``].

    ``matrices``: at the states of a machine. ``loss_factor`` [-]: of the stiffness. ``rigid``:
    indices of the motions that are zero, whatever acts (``constraint``).
    """

    name: str
    dofs: Indices
    motions: Array
    matrices: AtState
    loss_factor: float = 0.0
    rigid: tuple[int, ...] = ()
