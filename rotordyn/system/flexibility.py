"""Static answers of a free rotor that is one chain, from the forces in it.

Cut anywhere, the chain shows the force there by equilibrium alone; strains follow section by
section, displacements by summing them up. That costs a few sums over the nodes and keeps all digits
where a factor of the stiffness of ten thousand short elements would lose most of them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import InvalidInput
from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.flexible import Problem, ritz_basis_of_large
from rotordyn.numerics.reduction import RitzBasis, ritz_basis
from rotordyn.numerics.sparse import Matrix, filled
from rotordyn.numerics.static_answers import Coupling
from rotordyn.system.hierarchic_rotor import bending_rigidities
from rotordyn.system.hierarchy import Hierarchy

Array = NDArray[np.float64]
Answer = Callable[[Array], Array]
AT_ONCE = 32  # loads, whose fields are kept small
MANY = 8  # vectors made for each vibration or load that is kept, about
MOST_DENSE = 6000  # freedoms; a dozen matrices of that size are 3.5 GB
MOST_ENTRIES = 400_000_000  # of such vectors, 3.2 GB


class Matrices(Protocol):
    """Of a motion of the free rotor, (size, size)."""

    @property
    def mass(self) -> Matrix: ...
    @property
    def stiffness(self) -> Matrix: ...


def free_vectors(
    elements: Hierarchy,
    own: Matrices,
    answer: Callable[[], Answer],
    cutoff: float,
    loads: Array,
    rigid: Array,
    couplings: Sequence[Coupling] = (),
    fields: Callable[[], Sequence[Matrix]] = tuple,
) -> RitzBasis:
    """The few vectors that carry a motion: of all eigenvectors, or of a large rotor from its static
    ``answer`` (``numerics.flexible``), the rest of which shall answer ``fields``.

    Raises
    ------
    InvalidInput : they do not fit into memory
    """
    if not elements.large:
        return ritz_basis(own.mass, own.stiffness, cutoff, loads, rigid, couplings)
    problem = Problem(own.mass, own.stiffness, rigid, answer(), elements.order)
    many = MANY * (problem.below(cutoff) + loads.shape[1])
    if many > problem.size and problem.size <= MOST_DENSE:
        dense = [each._replace(matrix=filled(each.matrix)) for each in couplings]
        return ritz_basis(filled(own.mass), filled(own.stiffness), cutoff, loads, rigid, dense)
    if many * problem.size > MOST_ENTRIES:
        raise InvalidInput(
            f"{many / MANY:.0f} vibrations and loads of a rotor of {problem.size} freedoms are too "
            f"many; allowed: up to {MOST_ENTRIES / MANY / problem.size:.0f}; ask for lower "
            "frequencies or less accuracy, or join sections that are alike"
        )
    return ritz_basis_of_large(problem, cutoff, loads, couplings, fields())


def bending_answer(spindle: Spindle, elements: Hierarchy, stiffness: Matrix) -> Answer:
    """x with ``stiffness`` · x = f and no motion of the first node, of loads f (size, k).

    The loads have no resultant. Inner freedoms and jumps stand alone in ``stiffness`` (size, size).
    """
    h = elements.mesh.length[:, None]
    shear, bend = (each[:, None] for each in bending_rigidities(spindle, elements.mesh))
    turn, tip = h / bend, h**2 / (2.0 * bend)
    deflect = h**3 / (3.0 * bend) + h / shear

    def nodal(load: Array) -> Array:
        force, moment = load[0::2], load[1::2]
        across = _behind(force)
        given = moment[1:].copy()
        given[:-1] += h[1:] * across[1:]
        bent = _from_rear(given)
        rotation = _from_front(tip * across + turn * bent)
        deflection = _from_front(h * rotation[:-1] + deflect * across + tip * bent)
        return np.stack([deflection, rotation], axis=1).reshape(load.shape)

    return _answer(nodal, 2 * elements.mesh.nodes, stiffness)


def rod_answer(rigidity: Array, elements: Hierarchy, stiffness: Matrix) -> Answer:
    """The same of a rod with ``rigidity`` E A [N] or G Ip [N·m²] of its elements (elements,)."""
    give = (elements.mesh.length / rigidity)[:, None]

    def nodal(load: Array) -> Array:
        return _from_front(give * _behind(load))

    return _answer(nodal, elements.mesh.nodes, stiffness)


def _answer(nodal: Callable[[Array], Array], first: int, stiffness: Matrix) -> Answer:
    """Of nodes, ``first`` freedoms, and of the others, each by its own stiffness."""
    alone = stiffness.diagonal()[first:, None]

    def answer(load: Array) -> Array:
        found = np.empty_like(load)
        for start in range(0, load.shape[1], AT_ONCE):
            own = slice(start, start + AT_ONCE)
            found[:first, own] = nodal(load[:first, own])
        found[first:] = load[first:] / alone
        return found

    return answer


def _behind(load: Array) -> Array:
    """Sum of what acts behind each element (elements, k)."""
    return _from_rear(load[1:])


def _from_rear(values: Array) -> Array:
    return np.cumsum(values[::-1], axis=0)[::-1]


def _from_front(change: Array) -> Array:
    """Values at the nodes (nodes, k) from changes over the elements, 0 at the front."""
    return np.concatenate([np.zeros_like(change[:1]), np.cumsum(change, axis=0)])
