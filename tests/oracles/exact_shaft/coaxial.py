"""Rotors on one axis without discretisation: their shafts side by side, joined at common nodes.

Every piece of the row holds a piece of each shaft between the same two stations, of length zero
where the shaft does not reach: its state passes unchanged, free of forces. A joint is a piece
without length that gives way.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from rotordyn.equation.elements.shear import shear_coefficient
from rotordyn.equation.support import node_matrix
from rotordyn.errors import NoSolution
from rotordyn.machine.cross_section import area, second_moment
from rotordyn.machine.joint import Joint
from rotordyn.machine.spindle import Spindle
from tests.oracles.cylinders import of_cylinders
from tests.oracles.dense_rotor.lumped import lumped_element
from tests.oracles.exact_shaft.bending import box_around
from tests.oracles.exact_shaft.box import Box
from tests.oracles.exact_shaft.circular import PLANES, TURNING
from tests.oracles.exact_shaft.nodes import NodeTerms
from tests.oracles.exact_shaft.rotor import ExactRotor
from tests.oracles.exact_shaft.segment import Segments, transfer
from tests.oracles.exact_shaft.shooting import Shooting
from tests.oracles.exact_shaft.spectrum import modes_inside, modes_near

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
SAME = 1e-9  # of the machine: stations nearer to one another are one
EDGE = 0.05  # of the band, by which poles of coarse cones may lie beyond it
BESIDE = 1e-8
WAYS = ("radial", "tilt")


@dataclass(frozen=True, eq=False)
class Row:
    """One shaft of several.

    ``segments``: of all pieces of the row; ``joints``: of the shaft, by piece; ``spin`` [rad/s].
    """

    segments: Segments
    joints: dict[int, Joint]
    spin: float

    def parts(self, omega: float) -> NDArray[np.intp]:
        """Into how many each piece must be cut for whirl up to ``omega`` [rad/s]."""
        parts = np.ones(len(self.segments.length), dtype=np.intp)
        there = np.flatnonzero(self.segments.length)
        own = self.segments.cut(there, self.segments.length[there])
        parts[there] = own.parts(omega, self.spin)
        return parts

    def divided(self, parts: NDArray[np.intp]) -> Row:
        """Every piece cut into equal ``parts`` (pieces,); joints are never cut."""
        first = np.cumsum(parts) - parts
        joints = {int(first[piece]): joint for piece, joint in self.joints.items()}
        return replace(self, segments=self.segments.divided(parts), joints=joints)

    def gives(self, piece: int, omega: Complex, side: int) -> Complex:
        """Deflection and tilt (k, 2) [m/N, rad/(N·m)] by which a joint gives way per unit force
        and moment of a circular part: its dampers turn with the shaft."""
        joint, turning = self.joints[piece], omega - (1, -1)[side] * self.spin
        held = [
            getattr(joint, way) + 1j * turning * getattr(joint, f"{way}_damping") for way in WAYS
        ]
        rigid = [math.isinf(getattr(joint, way)) for way in WAYS]
        ways = zip(held, rigid, strict=True)
        return np.stack([np.zeros_like(omega) if r else 1.0 / h for h, r in ways], axis=-1)


@dataclass(frozen=True, eq=False)
class CoaxialRotor(ExactRotor):
    """``rows``: one for each shaft. Displacements of a node are deflection and tilt of both
    circular parts of each shaft; ``segments`` and ``spin`` are those of the first."""

    rows: tuple[Row, ...]

    def up_to(self, omega: float) -> CoaxialRotor:
        """The same with pieces short enough for whirl up to ``omega`` [rad/s]."""
        parts = np.max([row.parts(abs(omega)) for row in self.rows], axis=0)
        places = np.concatenate([[0], np.cumsum(parts)])
        rows = tuple(row.divided(parts) for row in self.rows)
        x = np.interp(np.arange(places[-1] + 1), places, self.x)
        terms = self.terms.spread(places)
        return replace(self, x=x, rows=rows, terms=terms, segments=rows[0].segments)


@dataclass(frozen=True, eq=False)
class CoaxialShooting(Shooting):
    """All shafts together by multiple shooting."""

    rotor: CoaxialRotor

    @property
    def passage(self) -> float:
        """Time [s] that waves take to pass all shafts."""
        return sum(2.0 * row.segments.passage for row in self.rotor.rows)

    @property
    def _units(self) -> Array:
        return np.array([self.unit_length, 1.0] * (self.rotor.width // 2))

    def _states(self, scaled: Segments, omega: Complex | Array) -> Complex:
        """From the start to the end of pieces (k, pieces, 2w, 2w)."""
        w, pieces = self.rotor.width, len(scaled.length)
        whole = np.zeros((*omega.shape, pieces, 2 * w, 2 * w), dtype=complex)
        soft = self.unit_force * self.unit_length / np.array([self.unit_length, 1.0]) ** 2
        for place, row in enumerate(self.rotor.rows):
            for side, spin in enumerate((row.spin, -row.spin)):
                own = transfer(self._in_units(row.segments), omega, spin).astype(complex)
                for piece in row.joints:
                    give = row.gives(piece, np.asarray(omega, dtype=complex), side) * soft
                    own[..., piece, (0, 1), (2, 3)] += give
                d = 4 * place + 2 * side
                at = np.array([d, d + 1, w + d, w + d + 1])
                whole[..., at[:, None], at] = own
        return whole


def coaxial_rotor(spindle: Spindle, spin: float) -> CoaxialRotor:
    """The shaft and the further rotors of ``spindle`` at ``spin`` [rad/s], all of cylinders, on
    linear supports between one another and ground."""
    parts = {name: spindle.part(name) for name in spindle.ratios}
    of = list(parts)
    stations = [*(b for p in parts.values() for b in p.shaft.boundaries)]
    stations += [s.x for s in spindle.supports]
    stations += [body.x for p in parts.values() for body in p.lumped]
    joints = [(joint.x, name, joint) for name, p in parts.items() for joint in p.joints]
    x = np.sort([*stations, *(at for at, _, _ in joints)])
    x = x[np.concatenate([[True], np.diff(x) > SAME * (x[-1] - x[0])])]
    x = np.sort(np.concatenate([x, [x[np.abs(x - at).argmin()] for at, _, _ in joints]]))

    def node(at: float) -> int:
        return int(np.abs(x - at).argmin())  # the first of two: in front of the joint

    ratios = spindle.ratios
    rows = tuple(
        Row(
            _segments(part, x),
            {node(at): joint for at, owner, joint in joints if owner == name},
            ratios[name] * spin,
        )
        for name, part in parts.items()
    )
    width = 4 * len(parts)
    real = {name: np.zeros((len(x), width, width)) for name in ("stiffness", "damping", "mass")}
    polar = np.zeros((len(x), width))
    for support in spindle.supports:
        reach = np.zeros((4, width))
        for sign, end in ((1.0, support.holds), (-1.0, support.against)):
            if end != "ground":
                reach[:, 4 * of.index(end) : 4 * of.index(end) + 4] += sign * np.eye(4)
        for which in ("stiffness", "damping"):
            held = PLANES.take(node_matrix(getattr(support, which)))
            real[which][node(support.x)] += reach.T @ held @ reach
    for place, (name, part) in enumerate(parts.items()):
        own = slice(4 * place, 4 * place + 4)
        for body in part.lumped:
            real["mass"][node(body.x), own, own] += PLANES.take(lumped_element(body).mass)
            spun = ratios[name] * body.polar_inertia
            polar[node(body.x), own][[1, 3]] += (spun, -spun)
    across = np.kron(np.eye(len(parts)), np.kron(TURNING, np.eye(2)))
    back = np.linalg.inv(across)
    turned = {name: (across @ own @ back).astype(complex) for name, own in real.items()}
    terms = NodeTerms(**turned, polar=(polar[:, :, None] * np.eye(width)).astype(complex))
    return CoaxialRotor(x, rows[0].segments, terms, spin, 2, rows)


def _segments(part: Spindle, x: Array) -> Segments:
    """Of a shaft between the nodes ``x``; of length zero where it does not reach."""
    shaft = part.shaft
    middle = 0.5 * (x[1:] + x[:-1])
    edge = np.array(shaft.boundaries)
    there = (middle > edge[0]) & (middle < edge[-1])
    chosen = np.clip(np.searchsorted(edge, middle) - 1, 0, len(shaft.sections) - 1)
    sections = [shaft.sections[k] for k in chosen]
    outer = np.array([s.outer_diameter for s in sections])
    inner = np.array([s.inner_diameter for s in sections])
    material = [s.material for s in sections]
    young = np.array([m.young_modulus for m in material])
    poisson = np.array([m.poisson_ratio for m in material])
    density = np.array([m.density for m in material])
    kappa = shear_coefficient(shaft.shear_coefficient, poisson, inner / outer)
    ring, moment = area(outer, inner), second_moment(outer, inner)
    return Segments(
        length=np.where(there, np.diff(x), 0.0),
        shear=kappa * young / (2.0 * (1.0 + poisson)) * ring,
        bending=young * moment,
        line_mass=density * ring,
        rotary=density * moment,
        tension=np.zeros(len(middle)),
    )


def coaxial_poles(
    spindle: Spindle, spin: float, near: Complex, highest: float
) -> tuple[Complex, Array]:
    """All oscillating poles of bending [rad/s], up to ``highest`` [rad/s] and a little farther, and
    how well each is known (relative): by pieces half as long, and of cones by ever more cylinders.

    ``near``: poles close to these, beyond the band as well; they only save time, as the number of
    poles is counted.

    Raises
    ------
    NoSolution : fewer or more poles are reached than are counted
    """
    box = box_around(-1j * near, 1.0, highest)
    reach = max(abs(box.low), abs(box.high))
    conical = _of_cylinders(spindle, 2) != spindle
    found: list[Complex] = []
    for count in (8, 16, 32, 64) if conical else (1, 1):
        machine = coaxial_rotor(_of_cylinders(spindle, count), spin)
        equations = CoaxialShooting.of(machine.up_to(2.0 * reach if found else reach))
        found.append(_found(equations, box, _starts(found) if found else -1j * near, found))
    if len({len(each) for each in found}) > 1:
        raise NoSolution("not every pole of the exact shafts was reached")
    last = found[-1]
    if not conical:
        return 1j * last, np.abs(found[0] / last - 1.0)
    row = found
    for power in (4.0, 16.0, 64.0):
        row = [(power * b - a) / (power - 1.0) for a, b in pairwise(row)]
        before, last = last, row[-1]
    return 1j * last, np.abs(last / before - 1.0)


def _found(equations: Shooting, box: Box, starts: Complex, before: list[Complex]) -> Complex:
    """The poles of a rotor: those of a coarser one led on, in their order, or all of the ``box``,
    counted."""
    if not before:
        inside = np.array([w for w in starts if w in box])
        return np.array([mode.omega for mode in modes_inside(equations, box, inside)])
    margin = EDGE * box.size
    wider = Box(box.low - margin, box.high + margin)
    omega = np.array([mode.omega for mode in modes_near(equations, wider, starts)])
    if len(omega) < len(starts):
        return omega
    _, chosen = linear_sum_assignment(np.abs(starts[:, None] - omega))
    return omega[chosen]


def _starts(found: list[Complex]) -> Complex:
    """Where a finer rotor has its poles, and a little beside: at a pole itself no step is known."""
    if len({len(each) for each in found}) > 1:
        raise NoSolution("not every pole of the exact shafts was reached")
    last = found[-1] if len(found) == 1 else found[-1] + (found[-1] - found[-2]) / 4.0
    return last * (1.0 + BESIDE)


def _of_cylinders(spindle: Spindle, count: int) -> Spindle:
    """Cones of all shafts as ``count`` cylinders between two stations."""
    shafts = {name: of_cylinders(spindle.part(name), count).shaft for name in spindle.ratios}
    rotors = tuple(replace(rotor, shaft=shafts[rotor.name]) for rotor in spindle.rotors)
    return replace(spindle, shaft=shafts["spindle"], rotors=rotors)
