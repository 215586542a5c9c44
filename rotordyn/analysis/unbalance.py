"""Steady response to unbalance: orbits at points, forces of bearings and supports, over speed.

Bending by elements, whatever ``shaft`` of the conditions says; bearings at their preload state of
each speed.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.accuracy import MOST_SPEEDS, synchronous_change
from rotordyn.analysis.branches import branches_of
from rotordyn.analysis.criticals import critical_speeds
from rotordyn.analysis.display import number
from rotordyn.analysis.mode_names import named
from rotordyn.analysis.orbit import orbit
from rotordyn.analysis.results import UnbalanceResult
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.specs import CampbellSpec, UnbalanceSpec
from rotordyn.analysis.unbalance_loads import Acting, acting, node_loads, unbalanced
from rotordyn.errors import NoSolution
from rotordyn.machine.rotor import Place
from rotordyn.numerics.modes import Modes
from rotordyn.system.hysteresis import SYNCHRONOUS
from rotordyn.system.longitudinal import RodSystem
from rotordyn.system.synchronous import displacements, frame_of, support_forces, synchronous

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
AXES = ("y", "z")
SLOWEST = 1e-9  # [rad/s]: below, no critical speed is sought
UNDAMPED = 1e-9  # of the speed: a pole so near to the excitation has no damping
BEYOND = 1.2  # times the top speed: up to there criticals are looked for


def answer(scene: Scene, spec: UnbalanceSpec) -> UnbalanceResult:
    """At every speed with a steady response.

    Raises
    ------
    NoSolution : no speed has one
    """
    spindle, rotor = scene.spindle, unbalanced(scene.spindle, spec)
    ratio = spindle.ratios[rotor]
    speed = ratio * scene.speed[scene.usable]
    system, turning = scene.answering("bending", SYNCHRONOUS)
    assert not isinstance(system, RodSystem), "bending is no rod"
    frame = frame_of(system, speed)
    absent = _absences(scene.vibration("bending")[1], turning, speed, frame)
    counts = (speed != 0.0) | (speed == 0.0).all()  # at rest nothing acts
    why = [word for word, one in zip(absent, counts, strict=True) if one]
    if all(why):
        raise NoSolution(f"no speed of the case has a steady response to unbalance: {why[0]}")
    steady = np.array([word == "" for word in absent])
    nodes = [scene.node(name) for name in spec.points]
    moved = synchronous(system, speed, node_loads(spindle, scene.mesh, spec))
    moved[~steady] = complex(np.nan, np.nan)
    displacement = scene.scattered(_in_time(ratio, displacements(system, moved, nodes)))
    force = scene.scattered(_in_time(ratio, support_forces(system, speed, moved)))
    ellipse = orbit(displacement[..., 0], displacement[..., 1])
    placed = acting(spindle, scene.mesh, spec)
    critical = _criticals(scene, ratio)
    return UnbalanceResult(
        speed=scene.speed,
        point=spec.points,
        axis=AXES,
        support=(*(s.name for s in spindle.seats), *(s.name for s in spindle.supports)),
        unbalance=tuple(one.name for one in placed),
        critical=tuple(name for name, *_ in critical),
        outcome=_outcome(scene, absent),
        displacement=displacement,
        amplitude=np.abs(displacement),
        phase=np.angle(displacement),
        major_axis=ellipse.major,
        minor_axis=ellipse.minor,
        inclination=ellipse.inclination,
        force=force,
        force_amplitude=orbit(force[..., 0], force[..., 1]).major,
        rotor=rotor,
        grade_speed=spec.grade.speed if spec.grade else 0.0,
        speed_ratio=ratio,
        unbalance_station=np.array([one.place.x for one in placed]),
        unbalance_size=np.array([abs(one.size) for one in placed]),
        unbalance_angle=np.array([np.angle(one.size) for one in placed]),
        critical_speed=np.array([speed for _, speed, _ in critical]),
        critical_damping=np.array([damping for *_, damping in critical]),
        error=_errors(scene, displacement, nodes, placed, ratio),
    )


def _in_time(ratio: float, moved: Complex) -> Complex:
    """From motions e^(irΩt) to motions e^(i|r|Ωt)."""
    return moved if ratio > 0.0 else moved.conj()


def _absences(found: Modes, turning: Modes, speed: Array, frame: Array) -> list[str]:
    """Per speed: empty, or why there is no steady response.

    ``turning``: the modes of motions that turn with the shaft.
    """
    words = []
    for row, spin in enumerate(speed):
        pole = found.pole[row]
        growing = found.growing[row]
        near = np.abs(turning.pole[row] - 1j * (spin - frame[row])).min() <= UNDAMPED * abs(spin)
        if growing.any():
            own = pole[growing][pole[growing].real.argmax()] + 1j * frame[row]
            hertz = abs(own.imag) / (2.0 * math.pi)
            how = f"vibrates by itself at {number(hertz)} Hz" if hertz else "moves away by itself"
            words.append(f"unstable: the machine {how}")
        elif near and spin != 0.0:
            words.append("a critical speed without damping: the response grows without bound")
        else:
            words.append("")
    return words


def _outcome(scene: Scene, absent: list[str]) -> tuple[str, ...]:
    """Why a speed has no steady response, or no state at all."""
    words = list(scene.outcome)
    for row, word in zip(scene.usable, absent, strict=True):
        words[row] = word
    return tuple(words)


def _criticals(scene: Scene, ratio: float) -> list[tuple[str, float, float]]:
    """Critical speeds among those of the case and the damping ratio at each, by the name of the
    mode, of what turns ``ratio`` times as fast."""
    top = float(scene.speed[-1])
    if len(scene.usable) < 2 or top < SLOWEST:
        return []
    highest = BEYOND * abs(ratio) * top / (2.0 * math.pi)
    spec = CampbellSpec(max_frequency=highest, shapes=False)
    branches, names = named(branches_of(scene, spec, ("bending",)))
    ratios = scene.spindle.ratios
    return [
        (each.mode, each.speed, each.damping_ratio)
        for each in critical_speeds(scene, spec, branches, names)
        if each.excited and ratios[each.line.rotor] == ratio
    ]


def _errors(
    scene: Scene, displacement: Complex, nodes: list[int], placed: list[Acting], ratio: float
) -> Array:
    """Largest estimated error over the largest displacement (points,), of some speeds."""
    size = np.abs(displacement[scene.usable]).max(axis=(1, 2))
    steady = np.flatnonzero(np.isfinite(size) & (scene.speed[scene.usable] > 0.0))
    if not steady.size:
        return np.zeros(len(nodes))
    rows = steady[np.unique(np.linspace(0, steady.size - 1, MOST_SPEEDS).round().astype(int))]
    rows = np.union1d(rows, steady[size[steady].argmax()])
    excited = [_nearest(scene, one.place) for one in placed]
    force = np.array([one.size for one in placed])
    worst = np.zeros(len(nodes))
    for row in rows.tolist():
        change = synchronous_change(scene, row, nodes, excited, ratio)
        spin = ratio * scene.speed[scene.usable[row]]
        off = np.abs(np.einsum("pkx,k->px", change, force * spin**2)).max(axis=1)
        worst = np.maximum(worst, off)
    peak = np.nanmax(np.abs(displacement), axis=(0, 2))
    return np.asarray(worst / np.where(peak > 0.0, peak, 1.0))


def _nearest(scene: Scene, place: Place) -> int:
    """The node next to a place, among those of all rotors."""
    rotor, x = place
    own = scene.mesh.of_rotors[rotor].x
    return scene.mesh.spans[rotor].start + int(np.abs(own - x).argmin())
