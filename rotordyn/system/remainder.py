"""What a reduced model leaves out, and how far that moves its poles and receptances.

Of the exact problem T(s) u = f only the block on the reduced coordinates is solved. Whatever else
there is, vectors that hardly couple among themselves, answers to the residual r of that solution by
r / (k + s² m), and the pole moves by Σ r_left r_right / (k + s² m) over the slope of T: the first
term of the exact Schur complement. The vectors are the inner freedoms that the next degrees of the
elements would add, and the modes of the free rotor that the reduction did not keep.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.numerics.reduction import RitzBasis
from rotordyn.numerics.sparse import Matrix
from rotordyn.system.geometric_stiffness import GeometricStiffness
from rotordyn.system.hierarchy import Hierarchy
from rotordyn.system.left_out_damping import LeftOutDamping, side_by_side

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
DEPENDENT = 1e-14  # of the largest, each in its own measure: directions that are rounding


@dataclass(frozen=True, eq=False, slots=True)
class Remainder:
    """r vectors left out beside m coordinates of one plane.

    ``mass``, ``stiffness``, ``polar`` (r, m): coupling with the coordinates; ``own_mass``,
    ``own_stiffness`` (r,); ``at_nodes`` (r, 2·nodes): deflections and tilts of the mesh's nodes.
    ``per_newton``: (r, m) by the axial force in each element of the mesh
    (none for rods; what finer elements would add to it is left aside), ``strung`` (r, m) by the
    drawbar. ``rounding`` (m,): of the stiffness of the coordinates themselves. ``damped``: the
    rotor's own damping; None without any.
    """

    mass: Array
    stiffness: Array
    polar: Array
    strung: Array
    own_mass: Array
    own_stiffness: Array
    at_nodes: Array
    per_newton: GeometricStiffness
    rounding: Array
    damped: LeftOutDamping | None = None

    def widened(self, more: int) -> Remainder:
        """Beside ``more`` further coordinates that couple with nothing left out."""
        wide = {n: np.pad(getattr(self, n), ((0, 0), (0, more))) for n in _COUPLINGS}
        return Remainder(
            mass=wide["mass"],
            stiffness=wide["stiffness"],
            polar=wide["polar"],
            strung=wide["strung"],
            own_mass=self.own_mass,
            own_stiffness=self.own_stiffness,
            at_nodes=self.at_nodes,
            per_newton=self.per_newton.padded(columns=more),
            rounding=np.pad(self.rounding, (0, more)),
            damped=self.damped and self.damped.widened(more),
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
        more = [len(rows[name]) - len(getattr(self, name)) for name in ("own_mass", "rounding")]
        pressed = self.per_newton.padded(rows=more[0], columns=more[1])
        damped = None
        if any(one.damped for one in every):
            damped = side_by_side([one.damped or one.undamped for one in every])
        return replace(self, **blocks, **rows, per_newton=pressed, damped=damped)

    @property
    def undamped(self) -> LeftOutDamping:
        """That of a rotor without any damping."""
        none = np.zeros_like(self.mass)
        return LeftOutDamping(none, np.zeros(len(none)), none)


_MATRICES = ("mass", "stiffness", "polar")
_COUPLINGS = (*_MATRICES, "strung")


def remainder(
    elements: Hierarchy,
    basis: RitzBasis,
    matrices: dict[str, Matrix],
    displayed: Matrix,
    per_newton: GeometricStiffness | None = None,
) -> Remainder:
    """Of ``elements`` reduced to ``basis``; ``displayed`` (2·nodes, size) as for the basis.

    ``matrices``: those of the whole, lumped bodies included; ``per_newton`` (rest of the basis, m):
    how axial force couples the two.
    """
    if per_newton is None:
        per_newton = GeometricStiffness(basis.rest[:0], basis.vectors[:0])
    finer = _gathered if elements.large else _of_finer_elements
    parts = [finer(elements, basis), _of_modes(basis, matrices, displayed)]
    names = (*_MATRICES, "own_mass", "own_stiffness")
    whole = {name: np.concatenate([part[name] for part in parts]) for name in names}
    count = len(parts[0]["own_mass"])
    return Remainder(
        mass=whole["mass"],
        stiffness=whole["stiffness"],
        polar=whole["polar"],
        strung=np.zeros_like(whole["mass"]),
        own_mass=whole["own_mass"],
        own_stiffness=whole["own_stiffness"],
        at_nodes=np.pad(parts[1]["at_nodes"], ((count, 0), (0, 0))),
        per_newton=per_newton.padded(before=count),
        rounding=basis.rounding,
    )


def _of_finer_elements(elements: Hierarchy, basis: RitzBasis) -> dict[str, Array]:
    """Inner freedoms of higher degree: they vanish at nodes and stand alone in stiffness."""
    found = elements.left_out(basis.vectors)
    zero = np.zeros_like(found["mass"])
    names = ("mass", "own_mass", "own_stiffness")
    return {name: found[name] for name in names} | {
        "stiffness": zero,
        "polar": found.get("polar", zero),
    }


def _gathered(elements: Hierarchy, basis: RitzBasis) -> dict[str, Array]:
    """The same of many elements in as few vectors as the basis couples with.

    Of inner freedoms x = k^-½ y only the y within the span of k^-½ [mass, polar] are met by forces.
    """
    m = basis.vectors.shape[1]
    gram, weighed = np.zeros((2 * m, 2 * m)), np.zeros((2 * m, 2 * m))
    for part in elements.left_out_by_parts(basis.vectors):
        met = np.concatenate([part["mass"], part.get("polar", 0.0 * part["mass"])], axis=1)
        met /= np.sqrt(part["own_stiffness"])[:, None]
        gram += met.T @ met
        weighed += met.T @ (met * (part["own_mass"] / part["own_stiffness"])[:, None])
    scale = np.sqrt(np.diagonal(gram))
    scale = np.where(scale > 0.0, scale, 1.0)
    size, turn = np.linalg.eigh(gram / scale[:, None] / scale)
    known = size > DEPENDENT * size[-1]
    root, turn = np.sqrt(size[known]), turn[:, known]
    inner = turn.T @ (weighed / scale[:, None] / scale) @ turn
    own, swung = np.linalg.eigh(inner / root[:, None] / root)
    met = swung.T @ (root[:, None] * turn.T) * scale
    return {
        "mass": met[:, :m],
        "polar": met[:, m:],
        "stiffness": np.zeros((len(own), m)),
        "own_mass": own,
        "own_stiffness": np.ones(len(own)),
    }


def _of_modes(basis: RitzBasis, matrices: dict[str, Matrix], displayed: Matrix) -> dict[str, Array]:
    """Modes of the free rotor above those kept."""
    rest = basis.rest
    mass = basis.rest_mass
    polar = rest.T @ (matrices["polar"] @ basis.vectors) if "polar" in matrices else 0.0 * mass
    return {
        "mass": mass,
        "stiffness": basis.rest_values[:, None] * mass,
        "polar": polar,
        "own_mass": np.ones(len(mass)),
        "own_stiffness": basis.rest_values,
        "at_nodes": (displayed @ rest).T,
    }
