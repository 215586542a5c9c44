"""The equation of motion of one subsystem in its coordinates, at many speeds:

    q̈ + C(Ω) q̇ + K(Ω) q = f

C holds the gyroscopic effect, K what damping in turning parts, axial force and bearings add. Where
supports are rigid, q = A p with the motions A that they allow (``constraint``).
Subsystems are components that links or the gyroscopic effect join.

Theory: docs/theory/rotor.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import accumulate, pairwise
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from rotordyn.equation.axial_force import geometric_stiffness
from rotordyn.equation.component import Component
from rotordyn.equation.constraint import DEPENDENT, allowed_motions
from rotordyn.equation.dofs import DIRECTIONS, position
from rotordyn.equation.structure import Structure, _Union
from rotordyn.equation.support import answers_alike
from rotordyn.equation.term import Array, Link, LinkMatrices, Matrices, State
from rotordyn.machine.support import SPINDLE
from rotordyn.numerics.modes import NOTHING

T = TypeVar("T", bound=Matrices)


def _some(values: Array, rows: NDArray[np.intp]) -> Array:
    """Of values (s or 1, …) those of some speeds; one serves all."""
    return values if len(values) == 1 else values[rows]


class Loss(NamedTuple):
    """Loss factors times stiffness: of what does not turn (s or 1, n, n), of shafts in bending
    (n, n), and the latter from plane z to plane y, with opposite sign back (n, n)."""

    fixed: Array
    turning: Array
    across: Array

    def at(self, rows: NDArray[np.intp]) -> Loss:
        """At some of the speeds."""
        return self._replace(fixed=_some(self.fixed, rows))


Complex = NDArray[np.complex128]


class Connection(NamedTuple):
    """A link in the coordinates: motions (k, n), matrices (s or 1, k, k)."""

    link: Link
    motions: Array
    matrices: LinkMatrices

    def at(self, rows: NDArray[np.intp]) -> Connection:
        """At some of the speeds."""
        own = LinkMatrices(*(_some(each, rows) for each in self.matrices))
        return self._replace(matrices=own)

    @property
    def rigid(self) -> Array:
        """1 of motions without give, else 0 (k,)."""
        flags = np.zeros(len(self.motions))
        flags[list(self.link.rigid)] = 1.0
        return flags

    def force(self, omega: Array, moved: Complex) -> Complex:
        """Of the link's springs and dampers on what it holds (s, k), by coordinates ``moved``
        (s, n) that swing at ``omega`` (s,) [rad/s]."""
        lossy = 1.0 + 1j * self.link.loss_factor * np.sign(omega)[:, None, None]
        dynamic = (
            self.matrices.stiffness * lossy + 1j * omega[:, None, None] * self.matrices.damping
        )
        return -np.einsum("sij,sj->si", dynamic, moved @ self.motions.T)


@dataclass(frozen=True, eq=False)
class Linear:
    """One subsystem at ``speed`` (s,): real ``stiffness`` and ``damping`` (s, n, n), mass 1.

    Coordinates are those of ``components``, in this order: plane y, plane z, all others.
    ``allowed`` A (n, m), orthonormal: the motions that rigid supports allow, in the same order;
    None where there are none.
    """

    structure: Structure
    components: tuple[Component, ...]
    speed: Array
    stiffness: Array
    damping: Array
    connections: tuple[Connection, ...]
    loss: Loss | None = None
    allowed: Array | None = None

    @cached_property
    def gyroscopic(self) -> Array:
        """G (n, n): what of ``damping`` is per unit of the spindle's speed."""
        whole = np.zeros((self.size, self.size))
        for y, z in _planes(self):
            own, other = self.slices[y], self.slices[z]
            polar = self.structure.gyroscopic(self.components[y], self.components[z])
            whole[own, other], whole[other, own] = polar, -polar.T
        return whole

    @property
    def size(self) -> int:
        """Coordinates n."""
        return self.stiffness.shape[-1]

    def at(self, rows: NDArray[np.intp]) -> Linear:
        """At some of the speeds."""
        return replace(
            self,
            speed=self.speed[rows],
            stiffness=self.stiffness[rows],
            damping=self.damping[rows],
            connections=tuple(each.at(rows) for each in self.connections),
            loss=None if self.loss is None else self.loss.at(rows),
        )

    def within(self, matrix: T) -> T:
        """Of a matrix (…, n, n) what acts in the motions that rigid supports allow (…, m, m)."""
        if self.allowed is None:
            return matrix
        return np.asarray(self.allowed.T @ (matrix @ self.allowed))  # type: ignore[return-value]

    @property
    def basis(self) -> Array:
        """``allowed``, or all coordinates (n, m)."""
        return np.eye(self.size) if self.allowed is None else self.allowed

    @cached_property
    def slices(self) -> list[slice]:
        """Coordinates of each component."""
        ends = accumulate((c.size for c in self.components), initial=0)
        return [slice(a, b) for a, b in pairwise(ends)]

    @property
    def motions(self) -> frozenset[str]:
        """Those of "bending", "axial" and "torsion" that take part."""
        own = {line.motion for component in self.components for line in component.lines}
        return frozenset(own - {""})

    def energy_of(self, motion: str) -> NDArray[np.bool_]:
        """Coordinates (n,) of shafts that are of a motion."""
        chosen = np.zeros(self.size, dtype=bool)
        for component, own in zip(self.components, self.slices, strict=True):
            chosen[own] = component.spindle is not None and component.lines[0].motion == motion
        return chosen

    @cached_property
    def rigid(self) -> NDArray[np.bool_]:
        """Coordinates that are rigid motions of shafts (n,)."""
        return np.concatenate(
            [c.is_rigid & (c.spindle is not None) for c in self.components] or [np.zeros(0, bool)]
        )

    @cached_property
    def motion(self) -> Array:
        """Displacements of the shown nodes by the coordinates (nodes, 6, n)."""
        return self.structure.motion(self.components)

    @cached_property
    def planes(self) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Coordinates of plane y and, in the same order, of plane z, where bodies have both."""
        pairs = [(self.slices[a], self.slices[b]) for a, b in _planes(self)]
        every, none = np.arange(self.size), np.zeros(0, dtype=np.intp)
        return (
            np.concatenate([none, *(every[y] for y, _ in pairs)]),
            np.concatenate([none, *(every[z] for _, z in pairs)]),
        )

    def row(self, rotor: str, x: float, direction: str) -> Array:
        """Displacement of the node at station ``x`` [m] of a rotor in one direction (n,)."""
        number = self.structure.node(rotor, x)[position(direction)]
        return self.displaced(np.array([number]))[0]

    def displaced(self, dofs: NDArray[np.intp]) -> Array:
        """Displacements of DOF in their directions by the coordinates (DOF, n); zero of those of
        other subsystems."""
        rows, sign = np.zeros((len(dofs), self.size)), self.structure.dofs.sign
        for component, own in zip(self.components, self.slices, strict=True):
            mine = component.has(dofs)
            vectors = component.vectors[component.local(dofs[mine])]
            rows[mine, own] = sign[dofs[mine], None] * vectors
        return rows

    def free_directions(self, rows: Iterable[int]) -> list[int]:
        """How many motions nothing holds at some of the speeds: those that strain no body and that
        no link answers, whatever its stiffness, unless that is ``NOTHING`` beside the largest;
        axial force is left out."""
        still, moved, sizes = self._unstrained, [], []
        for each in self.connections:
            own, size = each.motions @ still, np.linalg.norm(each.motions, axis=1)
            sizes.append(np.outer(size, size))
            own[np.linalg.norm(own, axis=1) <= DEPENDENT * size] = 0.0
            moved.append(_of_unit_rows(own))
        known: dict[bytes, int] = {}  # which entries are zero is the same at most speeds
        found = []
        for row in rows:
            held = [_some(c.matrices.stiffness, np.array([row]))[0] for c in self.connections]
            least = NOTHING * np.abs(self.stiffness[row]).max(initial=0.0)
            held = [
                np.where(np.abs(matrix) * size < least, 0.0, matrix)
                for matrix, size in zip(held, sizes, strict=True)
            ]
            key = b"".join((matrix != 0.0).tobytes() for matrix in held)
            if key not in known:
                answers = [np.zeros((1, still.shape[1]))]
                for each, matrix, own in zip(self.connections, held, moved, strict=True):
                    answers.append((_of_unit(matrix) + np.diag(each.rigid)) @ own)
                rank = int(np.linalg.matrix_rank(np.concatenate(answers), DEPENDENT))
                known[key] = still.shape[1] - rank
            found.append(known[key])
        return found

    @property
    def _unstrained(self) -> Array:
        """Motions that strain no body (n, k)."""
        found = [np.zeros((self.size, 0))]
        for component, own in zip(self.components, self.slices, strict=True):
            values, vectors = np.linalg.eigh(component.stiffness)
            free = vectors[:, values <= DEPENDENT**2 * np.abs(values).max(initial=0.0)]
            found.append(np.zeros((self.size, free.shape[1])))
            found[-1][own] = free
        return np.hstack(found)

    def too_stiff(self) -> str:
        """A sentence about the stiffest link."""

        def largest(each: Connection) -> float:
            return float(np.abs(_between(each.motions, each.matrices.stiffness)).max())

        stiffest = max(self.connections, key=largest)
        return (
            f"'{stiffest.link.name}' is so stiff, {np.abs(stiffest.matrices.stiffness).max():.0e} "
            "N/m, that slow motions beside it are lost in rounding: hold it rigid, or lower its "
            "stiffness"
        )

    def rigid_force(self, unbalanced: Complex) -> dict[str, Complex]:
        """Forces of rigid supports on what they hold (s, 6), by name, where others leave
        ``unbalanced`` (s, n) to them; of motions without give only.

        NaN where supports that hold the same motion share it: their shares are not determined.
        """
        held = [each for each in self.connections if each.link.rigid]
        if not held:
            return {}
        rows = np.concatenate([each.motions[each.rigid > 0.0] for each in held])
        acting = np.flatnonzero(rows.any(axis=1))
        force = np.zeros((len(unbalanced), len(rows)), dtype=complex)
        answer, _, rank, _ = np.linalg.lstsq(rows[acting].T, -unbalanced.T, rcond=DEPENDENT)
        force[:, acting] = answer.T if rank == len(acting) else complex(np.nan, np.nan)
        found, begin = {}, 0
        for each in held:
            own = np.zeros((len(unbalanced), len(each.motions)), dtype=complex)
            own[:, each.rigid > 0.0] = force[:, begin : begin + len(each.link.rigid)]
            found[each.link.name], begin = own, begin + len(each.link.rigid)
        return found

    @cached_property
    def isotropic(self) -> bool:
        """Both planes obey the same equations: forward and backward whirl are apart."""
        firsts = [c for c in self.components if c.way == "y"]
        seconds = [c for c in self.components if c.way == "z"]
        if len(firsts) + len(seconds) != len(self.components):
            return False
        if [c.lines[0].body for c in firsts] != [c.lines[0].body for c in seconds]:
            return False
        own = ("vectors", "stiffness", "damping", "turning")
        if not all(
            np.array_equal(getattr(y, name), getattr(z, name))
            for y, z in zip(firsts, seconds, strict=True)
            for name in own
        ):
            return False
        return all(
            answers_alike(own)
            for each in self.connections
            for own in (*each.matrices, np.diag(each.rigid))
            if own.shape[-1] == len(DIRECTIONS)
        )


def subsystems(structure: Structure, state: State, *, strings: bool) -> list[tuple[Component, ...]]:
    """Components that links join at any of the states, or that turn with one another."""
    every = structure.components
    groups = _Union(len(every))
    for k, one in enumerate(every):
        for other in range(k):
            same = one.lines[0].body == every[other].lines[0].body
            planes = {one.way, every[other].way} == {"y", "z"}
            if same and planes and one.spindle is not None:
                groups.join(k, other)
    links = [*structure.connections, *(structure.strings if strings else ())]
    for link in links:
        size = sum(np.abs(matrix).max(axis=0) for matrix in link.matrices(state))
        size = size + np.diag(np.isin(np.arange(len(size)), link.rigid))
        joined = np.abs(link.motions).T @ size @ np.abs(link.motions) > 0.0
        groups.join_where(structure.owner[link.dofs], joined)
    order = {"y": 0, "z": 1}
    return [
        tuple(
            sorted(
                (c for k, c in enumerate(every) if groups.find(k) == root),
                key=lambda c: order.get(c.way, 2),
            )
        )
        for root in groups.roots()
    ]


def linear(
    structure: Structure,
    components: Sequence[Component],
    state: State,
    force: Array | None = None,
    *,
    softened: bool = False,
    pull: float = 1.0,
) -> Linear:
    """The equation of a subsystem at every state.

    ``force`` (s, elements of the shown mesh) [N]: axial force in the spindle's shaft, tension
    positive; None: it and the drawbar do nothing to bending. ``softened``: Ω² M_ω is subtracted
    from the stiffness in the fixed frame, a formulation that no physics supports. ``pull``: share
    of the drawbar's tension that holds it straight.
    """
    speed, n = state.speed, sum(c.size for c in components)
    stiffness, damping = np.zeros((2, len(speed), n, n))
    found = Linear(structure, tuple(components), speed, stiffness, damping, ())
    spin, pulled = speed[:, None, None], force if force is not None and force.any() else None
    for component, own in zip(components, found.slices, strict=True):
        stiffness[:, own, own] += component.stiffness
        damping[:, own, own] += component.damping
        if softened and component.bends:
            stiffness[:, own, own] -= spin**2 * component.projected("softening")
        if pulled is not None and component.lines[0].body == SPINDLE and component.bends:
            stiffness[:, own, own] += geometric_stiffness(structure.slopes(component), pulled)
    damping += spin * found.gyroscopic
    for y, z in _planes(found):
        own, other = found.slices[y], found.slices[z]
        turning = components[y].turning
        stiffness[:, own, other] += spin * turning
        stiffness[:, other, own] -= spin * turning.T
    links = [(link, 1.0) for link in (*structure.connections, *structure.springs)]
    links += [(link, pull) for link in structure.strings] if force is not None else []
    connections = []
    for link, share in links:
        rows = _motions(found, link)
        if rows is None:
            continue
        held, damped = link.matrices(state)
        matrices = LinkMatrices(share * held, damped)
        stiffness += _between(rows, matrices.stiffness)
        if matrices.damping.any():
            damping += _between(rows, matrices.damping)
        connections.append(Connection(link, rows, matrices))
    return replace(
        found,
        connections=tuple(connections),
        loss=_loss(found, connections),
        allowed=_allowed(found, connections),
    )


def _allowed(linear: Linear, connections: Sequence[Connection]) -> Array | None:
    """Motions that rigid supports allow; coordinates of components that none joins stay apart."""
    none = np.zeros((0, linear.size))
    rows = np.concatenate([none, *(each.motions[each.rigid > 0.0] for each in connections)])
    rows = rows[rows.any(axis=1)]
    if not len(rows):
        return None
    groups = _Union(len(linear.components))
    touched = np.array([rows[:, own].any(axis=1) for own in linear.slices]).T
    for row in touched:
        for k in np.flatnonzero(row):
            groups.join(int(row.argmax()), int(k))
    blocks, every = [], np.arange(linear.size)
    for root in groups.roots():
        mine = [k for k in range(len(linear.components)) if groups.find(k) == root]
        own = np.concatenate([every[linear.slices[k]] for k in mine])
        held, block = rows[touched[:, mine].any(axis=1)][:, own], np.zeros((linear.size, len(own)))
        block[own, np.arange(len(own))] = 1.0
        if len(held):
            stiffness = [linear.components[k].stiffness.diagonal() for k in mine]
            block = block @ allowed_motions(held, np.concatenate(stiffness))
        blocks.append(block)
    return np.hstack(blocks)


def _motions(linear: Linear, link: Link) -> Array | None:
    """Relative motions of a link by the coordinates (k, n); None if it is of other subsystems."""
    rows, touched = np.zeros((len(link.motions), linear.size)), False
    for component, own in zip(linear.components, linear.slices, strict=True):
        mine = component.has(link.dofs)
        if mine.any():
            touched = True
            vectors = component.vectors[component.local(link.dofs[mine])]
            rows[:, own] = link.motions[:, mine] @ vectors
    return rows if touched else None


def _of_unit(matrix: Array) -> Array:
    """A matrix (n, n) with rows and columns in their own measure."""
    size = np.abs(matrix)
    scale = np.sqrt(np.maximum(size.max(axis=0), size.max(axis=1)))
    scale = np.where(scale > 0.0, scale, 1.0)
    return np.asarray(matrix / scale[:, None] / scale)


def _of_unit_rows(rows: Array) -> Array:
    """Rows (k, n) of length 1, or 0."""
    size = np.linalg.norm(rows, axis=1, keepdims=True)
    return np.asarray(rows / np.where(size > 0.0, size, 1.0))


def _between(rows: Array, blocks: Array) -> Array:
    """rowsᵀ block rows of blocks (s or 1, k, k): (s or 1, n, n)."""
    return np.asarray(rows.T @ (blocks @ rows))


def _planes(linear: Linear) -> list[tuple[int, int]]:
    """Places of plane y and plane z of every shaft among the components."""
    places = {(c.lines[0].body, c.way): k for k, c in enumerate(linear.components) if c.spindle}
    return [
        (k, places[body, "z"])
        for (body, way), k in places.items()
        if way == "y" and (body, "z") in places
    ]


def _loss(linear: Linear, connections: Sequence[Connection]) -> Loss | None:
    spindle = linear.structure.spindle
    if not spindle.hysteretic:
        return None
    n = linear.size
    fixed, turning, across = np.zeros((1, n, n)), np.zeros((n, n)), np.zeros((n, n))
    for component, own in zip(linear.components, linear.slices, strict=True):
        if component.spindle is not None:
            where = turning if component.bends else fixed[0]
            where[own, own] += spindle.loss_factor * component.stiffness
    for y, z in _planes(linear):
        own, other = linear.slices[y], linear.slices[z]
        across[own, other] += turning[own, own]
        across[other, own] -= turning[other, other]
    for link, rows, matrices in connections:
        if link.loss_factor:
            fixed = fixed + link.loss_factor * _between(rows, matrices.stiffness)
    return Loss(fixed, turning, across)
