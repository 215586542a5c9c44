"""How far computed frequencies and receptances may be off, by what the elements leave out."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.scene import Scene
from rotordyn.analysis.specs import Port
from rotordyn.elements.node import FREEDOMS
from rotordyn.machine.support import MOTIONS
from rotordyn.numerics.answers import answers
from rotordyn.numerics.modes import Modes
from rotordyn.system.coupled import CoupledSystem
from rotordyn.system.estimate import (
    NO_LOSS,
    CoupledResidualForces,
    Ground,
    LeftOut,
    Loss,
    ResidualForces,
    met,
    pole_shift,
    rounding_shift,
)
from rotordyn.system.hysteresis import Signs, gathered, signs_of
from rotordyn.system.lateral import LateralSystem
from rotordyn.system.longitudinal import RodSystem
from rotordyn.system.whirl_in_planes import FORWARD, receptance_in_planes

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
MOST_SPEEDS = 7  # at which receptances are judged
TILTS = ("thy", "thz")
GRID = 24  # frequencies at which they are, besides those of the modes


def left_out(
    scene: Scene, motion: str, signs: Signs | None = None, *, elements: bool = False
) -> LeftOut | None:
    """What the system that ``motion`` is part of leaves out; None of a rigid rotor.

    ``signs``: of the motions that its supports answer with their loss factors, none if left out;
    ``elements``: what these leave out, and not the coordinates they are reduced to.
    """
    system, found = scene.answering(motion, signs) if signs else scene.vibration(motion)
    if isinstance(system, CoupledSystem):
        parts = {}
        for name, part in system.parts.items():
            spin, loss = _spin(scene, name, len(found.pole)), _loss(scene, name, signs, part)
            own = ResidualForces.of(part, spin, loss, elements=elements)
            if own is None:
                return None
            parts[name] = own
        on = system.carried
        ground = None if on is None else Ground(on.held, on.damped, on.under, on.size)
        return CoupledResidualForces(
            parts, system.places, system.supports, system.at_supports, ground
        )
    spin, loss = _spin(scene, motion, len(found.pole)), _loss(scene, motion, signs, system)
    return ResidualForces.of(system, spin, loss, elements=elements)


def _loss(scene: Scene, motion: str, signs: Signs | None, part: LateralSystem | RodSystem) -> Loss:
    """Of the shaft in bending, as in ``Hysteresis``."""
    factor = scene.spindle.loss_factor
    if signs is None or motion != "bending" or not factor:
        return NO_LOSS
    ahead, behind, _ = signs
    if part.planes == 1:
        return Loss(1j * factor * ahead, 0j)
    return Loss(0.5j * factor * (ahead + behind), -0.5 * factor * (ahead - behind) + 0j)


def _spin(scene: Scene, motion: str, speeds: int) -> Array:
    """Speeds at which a motion feels the spin [rad/s]."""
    return scene.speed[scene.usable] if motion == "bending" else np.zeros(speeds)


def frequency_error(scene: Scene, motion: str, column: NDArray[np.intp]) -> Array:
    """Estimated relative error of the poles in ``column`` (speeds, k) of a motion's modes.

    Of what the elements leave out and of rounding. NaN where a column is negative; zero for a rigid
    rotor.
    """
    system, found = scene.vibration(motion)
    rest = left_out(scene, motion)
    lost = column < 0
    if rest is None:
        return np.where(lost, np.nan, 0.0)
    place = np.where(lost, 0, column)[: len(found.pole)]
    frame = getattr(system, "frame", np.zeros(len(found.pole)))[:, None]
    pole = np.take_along_axis(found.pole, place, axis=1) + 1j * frame
    vector = np.take_along_axis(found.vector, place[:, None, :], axis=2)
    participation = np.take_along_axis(found.participation, place[:, :, None], axis=1)
    missed = np.abs(pole_shift(rest, pole, vector, participation))
    rounded = rounding_shift(rest, found.stiffness, vector, participation)
    shift = (missed + rounded) / np.abs(pole)
    return np.where(lost, np.nan, np.broadcast_to(shift, lost.shape))


@dataclass(frozen=True, eq=False, slots=True)
class End:
    """One end of a receptance: ``row`` (n,) by the coordinates, ``seen`` (r,) by what is left out,
    ``plane`` 0 (y) or 1 (z)."""

    row: Array
    seen: Array
    plane: int


def receptance_error(
    scene: Scene,
    motion: str,
    pairs: Sequence[tuple[Port, Port]],
    frequency: Array,
    power: int = 0,
    *,
    elements: bool = False,
) -> Array:
    """Largest estimated error of each receptance over its peak (pairs,), of some speeds.

    By what is left out, or by the ``elements`` alone.

    Judged at ``GRID`` frequencies and those next to the modes; zero for a rigid rotor. ``power`` of
    the frequency by which receptances are multiplied: 1 of mobility, 2 of inertance.
    """
    found, rest = scene.vibration(motion)[1], left_out(scene, motion)
    if rest is None:
        return np.zeros(len(pairs))
    rows = np.linspace(0, len(found.pole) - 1, min(MOST_SPEEDS, len(found.pole))).round()
    ends = _ends(_motion(scene, motion), scene, pairs)
    worst = np.zeros(len(pairs))
    for place in np.unique(rows).astype(int):
        one = _at(scene, motion, place, elements=elements)
        omega = _judged(found.pole[place], 2.0 * math.pi * frequency)
        worst = np.maximum(worst, one.errors(ends, omega, power))
    return worst


def synchronous_change(
    scene: Scene, place: int, nodes: Sequence[int], excited: Sequence[int], ratio: float = 1.0
) -> Complex:
    """Estimated change (nodes, excited, 2) of what forces e^(irΩt) that turn with a rotor do.

    Along y and z at ``nodes``, per unit force on the nodes ``excited``, at one usable speed
    (``place``), ``ratio`` r; zero for a rigid rotor.
    """
    change = np.zeros((len(nodes), len(excited), 2), dtype=complex)
    if left_out(scene, "bending") is None:
        return change
    one = _at(scene, "bending", place)
    s = np.array([1j * (ratio * scene.speed[scene.usable[place]] - one.frame)])
    motion = _motion(scene, "bending")
    seen = {n: [_end_at(motion, n, way) for way in "yz"] for n in {*nodes, *excited}}
    pairs = [(r, f) for n in nodes for at in excited for r in seen[n] for f in seen[at]]
    own = one.receptances(pairs, s)[1].reshape(len(nodes), len(excited), 2, 2)
    return own[..., 0, :1] * FORWARD if one.whirling else own @ FORWARD


@dataclass(frozen=True, eq=False, slots=True)
class _OneSpeed:
    """A system at one speed: its modes, and what it leaves out, for every set of signs."""

    scene: Scene
    motion: str
    place: int
    frame: float
    whirling: bool
    elements: bool
    known: dict[Signs | None, tuple[Modes, LeftOut]]

    def errors(self, pairs: Sequence[tuple[End, End]], omega: Array, power: int) -> Array:
        """Largest change of each receptance over its largest value at ``omega`` (f,) (pairs,)."""
        both = np.concatenate([omega, -omega]) if self.whirling else omega
        value, change = self.receptances(pairs, np.asarray(1j * both))
        if self.whirling:
            turns = np.array([response.plane - force.plane for response, force in pairs])
            value, change = (
                receptance_in_planes(own, turns, self._planar) for own in (value, change)
            )
        weight = omega**power
        peak = np.abs(value * weight).max(axis=1)
        most = np.abs(change * weight).max(axis=1)
        return np.where(peak > 0.0, most / np.where(peak > 0.0, peak, 1.0), 0.0)

    @property
    def _planar(self) -> NDArray[np.bool_]:
        """True where nothing couples the planes of a system that whirls."""
        system = self.scene.vibration(self.motion)[0]
        assert isinstance(system, LateralSystem), "only bending whirls"
        own = slice(self.place, self.place + 1)
        return system.planar(np.array([self._spin]), own)[0]

    @property
    def _spin(self) -> float:
        if isinstance(self.scene.vibration(self.motion)[0], RodSystem):
            return 0.0
        return float(self.scene.speed[self.scene.usable[self.place]])

    def receptances(self, pairs: Sequence[tuple[End, End]], s: Complex) -> tuple[Complex, Complex]:
        """Receptances (response, force) and their changes at ``s`` (f,), (pairs, f) each.

        Those with an end in common are had from the answer to a force there, or to one where the
        response is taken, whichever are fewer.
        """
        forces, responses = ({id(pair[k]) for pair in pairs} for k in (1, 0))
        given = 1 if len(forces) <= len(responses) else 0
        side = 1.0 if given else -1.0
        value, change = np.zeros((2, len(pairs), len(s)), dtype=complex)
        for signs, at in self._signs(s):
            found, rest = self._answering(signs)
            seen = (s[at] + 1j * self.frame)[None]
            for own in _alike([pair[given] for pair in pairs]):
                end = pairs[own[0]][given]
                rows = np.array([pairs[k][1 - given].row for k in own])
                others = np.array([pairs[k][1 - given].seen for k in own])
                answer = answers(found, s[at], end.row[:, None], side)
                moved, back = met(rest, seen, answer[None], end.seen, side)
                value[np.ix_(own, at)] = rows @ answer
                onward = rows @ answers(found, s[at], back[0], side)
                change[np.ix_(own, at)] = onward - others @ moved[0]
        return value, change

    def _signs(self, s: Complex) -> Iterable[tuple[Signs | None, NDArray[np.bool_]]]:
        """Sets of signs at ``s`` (f,), and where they are; None without loss factors."""
        if self.scene.vibration(self.motion)[0].hysteresis is None:
            return [(None, np.ones(len(s), dtype=bool))]
        turning = s.imag + self.frame
        return gathered(signs_of(turning, np.array(self._spin), whirling=self.whirling))

    def _answering(self, signs: Signs | None) -> tuple[Modes, LeftOut]:
        if signs not in self.known:
            scene, motion = self.scene, self.motion
            found = (scene.answering(motion, signs) if signs else scene.vibration(motion))[1]
            rest = left_out(scene, motion, signs, elements=self.elements)
            if rest is None:
                raise ValueError("a rigid rotor leaves nothing out")
            self.known[signs] = found.at(np.array([self.place])), rest.at(self.place)
        return self.known[signs]


def _alike(ends: Sequence[End]) -> Iterable[NDArray[np.intp]]:
    """Places of each end in a list of them."""
    found: dict[int, list[int]] = {}
    for k, end in enumerate(ends):
        found.setdefault(id(end), []).append(k)
    return map(np.array, found.values())


def _at(scene: Scene, motion: str, place: int, *, elements: bool = False) -> _OneSpeed:
    """The system of a motion at one of its speeds."""
    system = scene.vibration(motion)[0]
    frame = 0.0 if isinstance(system, CoupledSystem) else float(system.frame[place])
    whirling = isinstance(system, LateralSystem) and system.isotropic
    return _OneSpeed(scene, motion, place, frame, whirling, elements, {})


def _judged(pole: Complex, omega: Array) -> Array:
    """Angular frequencies at which a receptance is judged [rad/s]."""
    grid = omega[np.unique(np.linspace(0, len(omega) - 1, min(GRID, len(omega))).astype(int))]
    known = np.abs(pole.imag)
    inside = known[(known >= omega[0]) & (known <= omega[-1])]
    near = omega[np.abs(omega - inside[:, None]).argmin(axis=1)] if inside.size else inside
    return np.unique(np.concatenate([grid, near]))


@dataclass(frozen=True, eq=False, slots=True)
class _Motion:
    """How the nodes move in the system of a motion: ``rows`` (nodes, 6, n), by its parts."""

    rows: Array
    parts: Mapping[str, LateralSystem | RodSystem]
    folded: int | None


def _motion(scene: Scene, motion: str) -> _Motion:
    system = scene.vibration(motion)[0]
    parts = system.parts if isinstance(system, CoupledSystem) else {motion: system}
    folded = None
    if isinstance(system, LateralSystem) and system.isotropic:
        folded = system.rotor.size
    return _Motion(system.motion, parts, folded)


def _ends(
    moved: _Motion, scene: Scene, pairs: Sequence[tuple[Port, Port]]
) -> list[tuple[End, End]]:
    """Ports as a system sees them, each once."""
    known = {
        port: _end_at(moved, scene.node(port.point), port.direction)
        for port in {port for pair in pairs for port in pair}
    }
    return [(known[response], known[excitation]) for response, excitation in pairs]


def _end_at(motion: _Motion, node: int, direction: str) -> End:
    row = motion.rows[node, FREEDOMS.index(direction)]
    seen = [_seen(part, name, node, direction) for name, part in motion.parts.items()]
    if motion.folded is not None:
        row = row[: motion.folded] + row[motion.folded :]
    return End(row, np.concatenate(seen), 0 if direction in ("y", "thz") else 1)


def _seen(part: LateralSystem | RodSystem, motion: str, node: int, direction: str) -> Array:
    """A node's freedom by what a part leaves out, zero if it is of another motion."""
    rest = part.remainder
    if rest is None:
        return np.zeros(0)
    count = len(rest.own_mass)
    if MOTIONS[direction] != motion:
        return np.zeros(count * part.planes)
    column = part.freedoms * node + (1 if motion == "bending" and direction in TILTS else 0)
    own = rest.at_nodes[:, column]
    if part.planes == 1:
        return own
    sign = -1.0 if direction == "thy" else 1.0
    zero = np.zeros(count)
    return np.concatenate((own, zero) if direction in ("y", "thz") else (zero, sign * own))
