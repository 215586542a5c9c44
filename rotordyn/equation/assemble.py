"""The sum over all terms: the equation of motion of every subsystem.

    q̈ + C(Ω) q̇ + K(Ω) q = f

Components (``structure``) bring M, K, C, G, N and S; links bring K′ and C′ of supports, bearings,
dampers and sleeves; the axial force brings its geometric stiffness.

Theory: docs/theory/rotor.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rotordyn.arrays import Array
from rotordyn.equation.axial_force import geometric_stiffness
from rotordyn.equation.component import Component
from rotordyn.equation.connection import Connection
from rotordyn.equation.constraint import allowed_motions, strained_motions
from rotordyn.equation.hysteresis import Hysteresis
from rotordyn.equation.linear import Linear, planes_identical
from rotordyn.equation.structure import Structure
from rotordyn.equation.term import Link, LinkMatrices, State
from rotordyn.machine.support import SPINDLE
from rotordyn.numerics.groups import first_joined, join

STIFF = 1e6  # of the softest mode's stiffness: links as stiff take six of its digits


def subsystems(structure: Structure, state: State, *, drawbar: bool) -> list[tuple[Component, ...]]:
    """Return groups of components that links join at any of the states, or that rotate with one
    another; ``drawbar``: whether it is one of these links."""
    components = structure.components
    joined = np.zeros((len(components), len(components)), dtype=bool)
    for k, component in enumerate(components):
        for other in range(k):
            same = component.lines[0].body == components[other].lines[0].body
            planes = {component.way, components[other].way} == {"y", "z"}
            if same and planes and component.spindle is not None:
                joined[k, other] = True
    links = [*structure.connections, *(structure.drawbar if drawbar else ())]
    for link in links:
        size = sum(np.abs(matrix).max(axis=0) for matrix in link.matrices(state))
        size = size + np.diag(np.isin(np.arange(len(size)), link.rigid))
        coupled = np.abs(link.motions).T @ size @ np.abs(link.motions) > 0.0
        join(joined, structure.owner[link.dofs], coupled)
    first = first_joined(joined)
    ordered = sorted(
        range(len(components)), key=lambda k: {"y": 0, "z": 1}.get(components[k].way, 2)
    )
    return [tuple(components[k] for k in ordered if first[k] == root) for root in np.unique(first)]


def assemble(
    structure: Structure,
    components: Sequence[Component],
    state: State,
    force: Array | None = None,
    *,
    softened: bool = False,
    pull: float = 1.0,
) -> Linear:
    """Return the equation of a subsystem at every state.

    ``force`` (s, elements of the shown mesh) [N]: axial force in the spindle's shaft, tension
    positive; None: neither it nor the drawbar affects bending. ``softened``: Ω² M_ω is subtracted
    from the stiffness in the fixed frame, a formulation that no physics supports. ``pull``: share
    of the drawbar's tension that acts in its string stiffness.
    """
    speed, n = state.speed, sum(c.size for c in components)
    stiffness, damping = np.zeros((2, len(speed), n, n))
    linear = Linear(structure, tuple(components), speed, stiffness, damping, ())
    spin, axial = speed[:, None, None], force if force is not None and force.any() else None
    for component, at in zip(components, linear.slices, strict=True):
        stiffness[:, at, at] += component.stiffness
        damping[:, at, at] += component.damping
        if softened and component.bends:
            stiffness[:, at, at] -= spin**2 * component.projected("softening")
        if axial is not None and component.lines[0].body == SPINDLE and component.bends:
            stiffness[:, at, at] += geometric_stiffness(structure.slopes(component), axial)
    damping += spin * linear.gyroscopic
    stiffness += spin * linear.turning
    links = [(link, 1.0) for link in (*structure.connections, *structure.sleeve_springs)]
    links += [(link, pull) for link in structure.drawbar] if force is not None else []
    connections, bodies = _joined(linear, links, state), stiffness.copy()
    for connection in connections:
        stiffness += connection.stiffness
        if connection.matrices.damping.any():
            damping += connection.damping
    linear = replace(linear, connections=tuple(connections), loss=_loss(linear, connections))
    linear = replace(linear, axisymmetric=planes_identical(linear))
    allowed = _allowed(linear, connections)
    if allowed is None:
        return linear
    if linear.axisymmetric:  # plane z has the very same coordinates as plane y
        half = [n // 2 for n in allowed.shape]
        allowed[half[0] :, half[1] :] = allowed[: half[0], : half[1]]
    return replace(linear, allowed=allowed, bodies=bodies)


def _joined(linear: Linear, links: Sequence[tuple[Link, float]], state: State) -> list[Connection]:
    """Return the links on a subsystem, each with a share of its stiffness, in its coordinates."""
    included = np.zeros(linear.structure.dofs.count, dtype=bool)
    for component in linear.components:
        included[component.dofs] = True
    links = [(link, share) for link, share in links if included[link.dofs].any()]
    dofs = [link.dofs for link, _ in links]
    motion = linear.moved(np.concatenate([np.zeros(0, dtype=np.intp), *dofs]))
    joined, end = [], 0
    for link, share in links:
        stiffness, damping = link.matrices(state)
        start, end = end, end + len(link.dofs)
        motions = link.motions @ motion[start:end]
        joined.append(Connection(link, motions, LinkMatrices(share * stiffness, damping)))
    return joined


def _allowed(linear: Linear, connections: Sequence[Connection]) -> Array | None:
    """Return the motions that rigid supports allow, those that strain very stiff links separate;
    coordinates of components that nothing joins are separate too."""
    size = np.concatenate([c.stiffness.diagonal() for c in linear.components])
    least, empty = STIFF * size[size > 0.0].min(initial=np.inf), np.zeros((0, linear.size))
    damped = any(c.damping.any() for c in linear.components) or any(c.damped for c in connections)
    if linear.loss is not None or damped:
        least = np.inf  # motions of damped systems would lose digits instead
    strained = [c.strained(least) for c in connections] if np.isfinite(least) else []
    stiff = np.concatenate([empty, *strained])
    held = [c.motions[c.rigid > 0.0] for c in connections if c.link.rigid]
    rigid = np.concatenate([empty, *held])
    rigid = rigid[rigid.any(axis=1)]
    rows = np.concatenate([rigid, stiff])
    if not len(rows):
        return None
    touched = np.array([rows[:, at].any(axis=1) for at in linear.slices]).T
    first = first_joined(touched.T @ touched)
    blocks, coordinates = [], np.arange(linear.size)
    for root in np.unique(first):
        joined = np.flatnonzero(first == root).tolist()
        at = np.concatenate([coordinates[linear.slices[k]] for k in joined])
        involved, block = np.any(touched[:, joined], axis=1), np.zeros((linear.size, len(at)))
        held, strained = rigid[involved[: len(rigid)]][:, at], stiff[involved[len(rigid) :]][:, at]
        allowed = allowed_motions(held, size[at]) if len(held) else np.eye(len(at))
        if len(strained):
            unstrained = allowed_motions(np.concatenate([held, strained]), size[at])
            allowed = np.hstack([unstrained, strained_motions(unstrained, allowed, strained)])
        block[at, np.arange(len(at))] = 1.0
        blocks.append(block @ allowed)
    return np.hstack(blocks)


def _loss(linear: Linear, connections: Sequence[Connection]) -> Hysteresis | None:
    """Return loss factors times stiffness; None where there are none."""
    spindle = linear.structure.spindle
    if not spindle.hysteretic:
        return None
    n, factor = linear.size, spindle.loss_factor
    fixed, rotating = np.zeros((1, n, n)), np.zeros((n, n))
    for component, at in zip(linear.components, linear.slices, strict=True):
        if component.spindle is not None:
            target = rotating if component.bends else fixed[0]
            target[at, at] += factor * component.stiffness
    for connection in connections:
        if connection.link.loss_factor:
            fixed = fixed + connection.link.loss_factor * connection.stiffness
    return Hysteresis(fixed, rotating, linear.across(lambda y, _: factor * y.stiffness))
