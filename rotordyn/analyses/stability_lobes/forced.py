"""Forced vibration of the tool in a stable cut, and the error of the surface that it leaves.

The forces of the teeth repeat with their pattern, and so does the vibration, each harmonic of which
is that of the force times the receptance. Evenly spaced teeth all follow the same path, so that no
chip depends on the vibration. With teeth that are unevenly spaced or run out, or flanks that rub,
forces depend on the vibration and are solved together with it.

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from bearings.arguments import typed
from rotordyn.analyses.stability_lobes.contact import Beyond, Contact
from rotordyn.analyses.stability_lobes.cutting import Cut, checked
from rotordyn.analyses.stability_lobes.forces import Forces
from rotordyn.arrays import Array, Complex
from rotordyn.errors import InvalidInput, NoSolution

Receptance = Callable[[Array], Complex]
WALLS = {"up": (0.0, -1.0), "down": (math.pi, 1.0)}  # angle at which a tooth leaves it, and sign
FINE = 8  # points of the shortest wave
SETTLED, ROUNDS = 1e-3, 40  # tolerance of the vibration as its contact converges, and iterations
LESS = 0.8  # ratio of successive changes above which steps are shortened
SHORTEST = 0.1  # of a full step
LOST = 100.0  # of the vibration: larger changes diverge
SEEN = 1e-8  # of the largest harmonic of the motion: smaller ones move no surface
SOLVED = 1e-10  # of the forces: relative residual
SEARCHED, RESTARTED = 80, 25  # directions of GMRES, and restarts
MOST_HARMONICS = 100_000
POINTS = 4000  # of a pattern, at which the largest force is searched
JUST = 1e-9  # of a turn of the pattern: distance inside the ends of a cut
AT_ONCE = 2_000_000  # values


@dataclass(frozen=True, slots=True)
class Milled:
    """Forced vibration, surface and forces of a stable cut at one speed.

    ``least``, ``most`` (walls,) [m]: range over the depth of the error of each wall as the deepest
    tooth leaves it, positive where material is left. In feed and normal (2,) [m]: ``deflection``,
    the mean displacement of the tip, and ``peak_to_peak``, its vibration. ``force``: the largest on
    the tip [N]; ``torque`` [N m] and ``power`` [W]: mean values. The vibration moves the ends of
    its own contact: ``departure``, the change of the vibration by that, and ``error``, the
    remaining change in its iteration, small where that converges, both over its size.
    """

    least: Array
    most: Array
    deflection: Array
    peak_to_peak: Array
    force: float
    torque: float
    power: float
    error: float
    departure: float


@dataclass(frozen=True)
class Forced:
    """Vibration by ``forces`` of a cutter of a ``diameter`` [m] at a ``speed`` [rad/s]; ``rubbing``
    force by depth and velocity normal to the cut surface [N s/m²]; harmonics to ``top`` [rad/s]."""

    forces: Forces
    diameter: float
    speed: float
    top: float
    rubbing: float = 0.0

    def solve(self, receptance: Receptance, walls: Sequence[str]) -> Milled:
        """Return the result with a ``receptance`` of the tip, function of angular frequencies ≥ 0.

        Raises
        ------
        InvalidInput : a cut so slow that it has too many harmonics
        NoSolution : forces of the vibration do not converge, as near the limit of stability
        """
        first = 2.0 * math.pi / self.forces.cut.turn
        count = math.ceil(self.top / (first * self.speed))
        if count > MOST_HARMONICS:
            raise InvalidInput(
                f"speed: given {self.speed:.6g} rad/s, {count} harmonics of the teeth in the band "
                f"of the receptance; allowed: up to {MOST_HARMONICS}"
            )
        order: Array = first * np.arange(count + 1.0)
        values = receptance(order * self.speed)
        force, torque = self.forces.harmonics(order), self.forces.mean_torque()
        if self.rubbing > 0.0 or not self.forces.cut.even:
            settled = self._converged(order, values, force)
            motion = np.einsum("kij,kj->ki", values, settled.force)
            largest = self._contact.largest(order, motion, settled.beyond)
            torque += settled.beyond.torque
            doubt = settled.error, settled.departure
        else:
            motion = np.einsum("kij,kj->ki", values, force)
            largest, doubt = self._largest_force(), (0.0, 0.0)
        least, most = self._surface(order, motion, walls)
        torque *= 0.5 * self.diameter
        return Milled(
            least,
            most,
            motion[0].real,
            np.ptp(_over_pattern(motion), axis=0),
            largest,
            torque,
            torque * self.speed,
            *doubt,
        )

    @property
    def _contact(self) -> Contact:
        return Contact(self.forces, self.speed, self.rubbing)

    def _converged(self, order: Array, receptance: Complex, alone: Complex) -> _Converged:
        """Iterate the forces of the vibration, which moves the ends of its own contact: their
        nonlinear part by the last motion is added, in full or shorter steps, until it converges."""
        loop, added = _Loop(self, order, receptance), np.zeros_like(alone)

        def size(force: Complex) -> float:
            path = _over_pattern(np.einsum("kij,kj->ki", receptance, force))
            return float(np.ptp(path, axis=0).max())

        linear = force = loop.solve(alone)
        share, error, best = 1.0, math.inf, math.inf
        for step in range(ROUNDS):
            beyond = self._contact.of(order, np.einsum("kij,kj->ki", receptance, force))
            change = loop.solve(beyond.force - added)
            scale = size(force) or 1.0  # a rigid tip does not move
            before, error = error, size(change) / scale
            if step == 0 or error < best:
                best = error
                result = _Converged(force, beyond, error, size(force - linear) / scale)
            if error < SETTLED or not error < LOST:
                break
            share = share if error < LESS * before else max(0.5 * share, SHORTEST)
            force, added = force + share * change, added + share * (beyond.force - added)
        return result

    def _surface(self, order: Array, motion: Complex, walls: Sequence[str]) -> tuple[Array, Array]:
        """Return least and largest error of each wall (walls,) [m]."""
        cut, matters = self.forces.cut, np.abs(motion[:, 1]) > SEEN * np.abs(motion).max()
        order, motion = order[matters], motion[matters]
        waves = cut.lag * order.max(initial=0.0) / (2.0 * math.pi)
        along = np.linspace(0.0, cut.lag, 1 + FINE * math.ceil(waves)) if waves else np.zeros(1)
        runout = np.array(cut.runout[: len(cut.gaps)] or (0.0,))[:, None]
        least, most = np.empty(len(walls)), np.empty(len(walls))
        for k, (angle, sign) in enumerate(WALLS[wall] for wall in walls):
            at = angle + along - cut.behind[:, None]
            error = sign * _motion(order, motion, at.ravel())[:, 1].reshape(at.shape) - runout
            deepest = error.min(axis=0)
            least[k], most[k] = deepest.min(), deepest.max()
        return least, most

    def _largest_force(self) -> float:
        """Return the largest force [N] of teeth that all follow the same path."""
        cut = self.forces.cut
        ends = np.array([end for low, high in cut.pieces() for end in (low, high)])
        inside = np.array([1.0, -1.0] * (len(ends) // 2)) * JUST * cut.turn
        angle = cut.turn * np.arange(POINTS) / POINTS
        angle = np.append(angle, np.mod(ends + inside, cut.turn))
        return float(np.hypot(*self.forces.at(angle)[:, :2].T).max())


class _Converged(NamedTuple):
    """Forces of a vibration (n, 2) and their nonlinear part ``beyond``; others as in ``Milled``."""

    force: Complex
    beyond: Beyond
    error: float
    departure: float


@dataclass(frozen=True)
class _Loop:
    """Feedback of the ``vibration`` on its forces; receptances (n, 2, 2) at orders (n,)."""

    vibration: Forced
    order: Array
    receptances: Complex

    def solve(self, alone: Complex) -> Complex:
        """Return all forces (n, 2), by those ``alone`` without vibration."""
        from scipy.sparse.linalg import LinearOperator, gmres

        receptances = self._both_signs(self.receptances)
        loops = self._loops()

        def closed(force: Complex) -> Complex:
            force = force.reshape(-1, 2)
            motion = np.einsum("kij,kj->ki", receptances, force)
            return np.asarray((force + sum(loop(motion) for loop in loops)).ravel())

        load = self._both_signs(alone)
        operator = LinearOperator((load.size, load.size), matvec=closed, dtype=complex)
        solution, failed = gmres(
            operator, load.ravel(), rtol=SOLVED, restart=SEARCHED, maxiter=RESTARTED
        )
        if failed:
            raise NoSolution(
                f"forces of the vibration do not converge at {self.vibration.speed:.6g} rad/s: the "
                "cut is near its limit of stability; take less depth"
            )
        return np.asarray(solution.reshape(-1, 2)[len(alone) - 1 :])

    def _both_signs(self, values: Complex) -> Complex:
        """Extend values (n, …) of orders ≥ 0 to orders of both signs (2n − 1, …)."""
        return np.concatenate([values[:0:-1].conj(), values])

    def _loops(self) -> list[Callable[[Complex], Complex]]:
        """Return functions from motion (2n − 1, 2) to force: of chips behind gaps, of flanks."""
        forces, speed = self.vibration.forces, self.vibration.speed
        step, count = self.order[1] - self.order[0], len(self.order)
        differences = step * np.arange(-2 * (count - 1), 2 * count - 1)
        order = step * np.arange(-(count - 1), count)
        scale = forces.depth * forces.repeats
        loops = []
        flank = replace(forces, cut=replace(forces.cut, tangential=0.0, radial=1.0))
        rubbed: Complex = np.zeros((len(differences), 2, 2), dtype=complex)
        for chip in forces.chips:
            factor = scale * np.exp(1j * differences * forces.cut.behind[chip.tooth])[:, None, None]
            if not forces.cut.even:
                kernel = factor * forces.by_displacement(differences, chip)
                loops.append(_convolved(kernel, 1.0 - np.exp(-1j * order * chip.gap)))
            if self.vibration.rubbing > 0.0:
                rubbed += factor * flank.by_displacement(differences, chip)
        if self.vibration.rubbing > 0.0:
            loops.append(
                _convolved(np.asarray(self.vibration.rubbing * rubbed), 1j * order * speed)
            )
        return loops


def _convolved(kernel: Complex, factor: Complex) -> Callable[[Complex], Complex]:
    """Return a function: convolution of ``kernel`` (2m − 1, 2, 2) with ``factor`` (m,) · motion."""
    from scipy.fft import fft, ifft, next_fast_len

    size, count = next_fast_len(len(kernel) + len(factor) - 1), len(factor)
    kernel_transform = fft(kernel, size, axis=0)

    def force(motion: Complex) -> Complex:
        spread = fft(factor[:, None] * motion, size, axis=0)
        product = ifft(np.einsum("kij,kj->ki", kernel_transform, spread), axis=0)
        return np.asarray(product[count - 1 : 2 * count - 1])

    return force


def _motion(order: Array, amplitude: Complex, angle: Array) -> Array:
    """Return motion (n, 2) at angles (n,) by its amplitudes (k, 2) of e^(i order angle), order ≥ 0;
    computed in parts to limit memory."""
    doubled = amplitude * np.where(order > 0.0, 2.0, 1.0)[:, None]
    parts = np.array_split(angle, max(1, len(angle) * len(order) // AT_ONCE))
    return np.concatenate([(np.exp(1j * part[:, None] * order) @ doubled).real for part in parts])


def _over_pattern(amplitude: Complex) -> Array:
    """Return values (n, …) over one turn of the pattern by harmonics from 0 up."""
    points = 2 * FINE * len(amplitude)
    return np.asarray(np.fft.irfft(amplitude, points, axis=0) * points)


@typed(InvalidInput, besides=("receptance",))
def milled(  # noqa: PLR0913  what a user of cutting data has at hand
    receptance: Receptance,
    depth: float,
    feed_per_tooth: float,
    teeth: int = 2,
    tangential: float = 6e8,
    radial: float = 2e8,
    entry: float = 0.0,
    exit: float = math.pi,
    speed: float = 1000.0,
    diameter: float = 0.02,
    helix: float = 0.0,
    pitch: Sequence[float] = (),
    tangential_edge: float = 0.0,
    radial_edge: float = 0.0,
    highest: float = 10_000.0,
    runout: Sequence[float] = (),
    process_damping: float = 0.0,
) -> Milled:
    """Return forced vibration, surface and forces of a stable cut.

    receptance : angular frequencies (f,) ≥ 0 [rad/s] -> (f, 2, 2) [m/N], tip in feed and normal
    depth, feed_per_tooth, diameter : [m]
    tangential, radial : cutting coefficients [Pa]; tangential_edge, radial_edge : of edges [N/m]
    entry, exit : angles of a tooth in cut [rad], from the normal towards the feed
    speed : of the cutter [rad/s]
    helix : angle of the edges [rad]
    pitch : angles from each tooth to the one that cut before it [rad], as in ``limit_depth``
    highest : frequency up to which the receptance is taken [Hz]
    runout : radial run-out of each tooth [m], in the order in which they cut
    process_damping : as in ``limit_depth`` [N/m]

    Walls are those that the cut leaves: "up" where entry is 0, "down" where exit is π. Stability
    is not checked: ``limit_depth`` gives the limit.

    Raises
    ------
    InvalidInput : an impossible cut, values that are not positive, too many harmonics
    NoSolution : see ``Forced.solve``
    """
    for name, value in (
        ("depth", depth),
        ("feed_per_tooth", feed_per_tooth),
        ("speed", speed),
        ("diameter", diameter),
        ("highest", highest),
    ):
        if not (value > 0.0 and math.isfinite(value)):
            raise InvalidInput(f"{name}: given {value:.6g}; allowed: above 0")
    if not 0.0 <= helix < 0.5 * math.pi * (1.0 - 1e-9):
        raise InvalidInput(f"helix: given {math.degrees(helix):.6g}°; allowed: from 0 to below 90°")
    if not process_damping >= 0.0:
        raise InvalidInput(f"process_damping: given {process_damping:.6g} N/m; allowed: from 0")
    if len(runout) not in (0, teeth):
        raise InvalidInput(f"runout: given {runout}; allowed: one for each of {teeth} teeth [m]")
    lag = 2.0 * depth * math.tan(helix) / diameter
    cut = checked(Cut(teeth, tangential, radial, entry, exit, lag, tuple(pitch), tuple(runout)))
    forces = Forces(cut, depth, feed_per_tooth, tangential_edge, radial_edge)
    ends = {"up": cut.entry == 0.0, "down": cut.exit == math.pi}
    walls = [wall for wall, left in ends.items() if left]
    rubbing = process_damping / (0.5 * diameter * speed)
    forced = Forced(forces, diameter, speed, 2.0 * math.pi * highest, rubbing)
    return forced.solve(receptance, walls)
