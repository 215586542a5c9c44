"""What a reduced model leaves out, and how far that moves its poles and receptances.

Of the exact problem T(s) u = f only the block on the reduced coordinates is solved. Whatever else
there is, vectors that hardly couple among themselves, answers to the residual r of that solution by
r / (k + s² m), and the pole moves by Σ r_left r_right / (k + s² m) over the slope of T: the first
term of the exact Schur complement. The vectors are the inner freedoms that the next degrees of the
elements would add, and the modes of the free rotor that the reduction did not keep.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from rotordyn.numerics.reduction import RitzBasis
from rotordyn.system.hierarchy import Hierarchy

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False, slots=True)
class Remainder:
    """r vectors left out beside m coordinates of one plane.

    ``mass``, ``stiffness``, ``polar`` (r, m): coupling with the coordinates; ``own_mass``,
    ``own_stiffness`` (r,); ``at_nodes`` (r, 2·nodes): deflections and tilts of the mesh's nodes.
    ``per_newton`` (elements, r, m): coupling per newton of axial force in each element of the mesh
    (none for rods; what finer elements would add to it is left aside). ``rounding`` (m,): of the
    stiffness of the coordinates themselves.
    """

    mass: Array
    stiffness: Array
    polar: Array
    own_mass: Array
    own_stiffness: Array
    at_nodes: Array
    per_newton: Array
    rounding: Array

    def widened(self, more: int) -> Remainder:
        """Beside ``more`` further coordinates that couple with nothing left out."""
        wide = {n: np.pad(getattr(self, n), ((0, 0), (0, more))) for n in _COUPLINGS}
        return Remainder(
            **wide,
            own_mass=self.own_mass,
            own_stiffness=self.own_stiffness,
            at_nodes=self.at_nodes,
            per_newton=np.pad(self.per_newton, ((0, 0), (0, 0), (0, more))),
            rounding=np.pad(self.rounding, (0, more)),
        )

    def beside(self, others: Sequence[Remainder]) -> Remainder:
        """With what other rotors leave out, on which no axial force acts."""
        from scipy.linalg import block_diag

        every = (self, *others)
        blocks = {
            n: block_diag(*(getattr(one, n) for one in every)) for n in (*_COUPLINGS, "at_nodes")
        }
        rows = {
            n: np.concatenate([getattr(one, n) for one in every])
            for n in ("own_mass", "own_stiffness", "rounding")
        }
        _, left_out, kept = self.per_newton.shape
        more = (len(rows["own_mass"]) - left_out, len(rows["rounding"]) - kept)
        pressed = np.pad(self.per_newton, ((0, 0), (0, more[0]), (0, more[1])))
        return Remainder(**blocks, **rows, per_newton=pressed)


_COUPLINGS = ("mass", "stiffness", "polar")


def remainder(
    elements: Hierarchy,
    basis: RitzBasis,
    matrices: dict[str, Array],
    displayed: Array,
    per_newton: Array | None = None,
) -> Remainder:
    """Of ``elements`` reduced to ``basis``; ``displayed`` (2·nodes, size) as for the basis.

    ``matrices``: those of the whole, lumped bodies included; ``per_newton`` (elements of the mesh,
    rest of the basis, m): how axial force couples the two.
    """
    if per_newton is None:
        per_newton = np.zeros((0, basis.rest.shape[1], basis.vectors.shape[1]))
    finer = _of_finer_elements(elements, basis, len(displayed), len(per_newton))
    higher = _of_modes(basis, matrices, displayed, per_newton)
    parts = {f.name: [getattr(finer, f.name), getattr(higher, f.name)] for f in fields(Remainder)}
    axis = {"per_newton": 1}
    return Remainder(**{n: np.concatenate(v, axis=axis.get(n, 0)) for n, v in parts.items()})


def _of_finer_elements(elements: Hierarchy, basis: RitzBasis, rows: int, pressed: int) -> Remainder:
    """Inner freedoms of higher degree: they vanish at nodes and stand alone in stiffness."""
    found = elements.left_out(basis.vectors)
    zero = np.zeros_like(found["mass"])
    return Remainder(
        mass=found["mass"],
        stiffness=zero,
        polar=found.get("polar", zero),
        own_mass=found["own_mass"],
        own_stiffness=found["own_stiffness"],
        at_nodes=np.zeros((len(zero), rows)),
        per_newton=np.zeros((pressed, *zero.shape)),
        rounding=np.zeros(0),
    )


def _of_modes(
    basis: RitzBasis, matrices: dict[str, Array], displayed: Array, per_newton: Array
) -> Remainder:
    """Modes of the free rotor above those kept."""
    rest = basis.rest
    mass = basis.rest_mass
    polar = rest.T @ (matrices["polar"] @ basis.vectors) if "polar" in matrices else 0.0 * mass
    return Remainder(
        mass=mass,
        stiffness=basis.rest_values[:, None] * mass,
        polar=polar,
        own_mass=np.ones(len(mass)),
        own_stiffness=basis.rest_values,
        at_nodes=(displayed @ rest).T,
        per_newton=per_newton,
        rounding=basis.rounding,
    )
