"""The equation of motion of all that the ports move, at every speed.

The same coordinates serve all speeds. How far they lead off the machine is estimated by a finer
model, at the first and the last speed: by its poles, and by receptances between the ports. These
are taken beside the axis of frequency, at s = ω (i + 0.05), where no peak is higher than with 5 %
of damping.

Theory: docs/theory/rotor.md.
"""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np

from rotordyn.analyses.matrices.result import MatricesResult
from rotordyn.analyses.matrices.spec import MatricesSpec
from rotordyn.arrays import Array, Complex, Indices
from rotordyn.scene.joined import Joined
from rotordyn.scene.refinement import (
    AT_REST,
    RESPONSES,
    changes,
    few_rows,
    response_accuracy,
    solve_accurately,
)
from rotordyn.scene.scene import Scene

GRID = 24  # frequencies at which the finer model is compared
BESIDE = 0.05  # damping ratio that these receptances have more
SLOW = 1e-3  # of the highest frequency: slower poles count as that fast
POINTS = 200  # of a receptance from zero to the highest frequency, besides those about its poles
ABOUT = np.array([-20.0, -6.0, -2.5, -1.0, -0.4, 0.0, 0.4, 1.0, 2.5, 6.0, 20.0])  # half widths
FREE = 1e-5  # of the highest frequency: a slower pole is that of what is free at zero
NARROW = 1e-6  # of the frequency: half the width of a peak; the top of a narrower one is left out


def answer(scene: Scene, spec: MatricesSpec) -> MatricesResult:
    """At every speed with a state.

    Raises
    ------
    NoSolution : no speed has one
    TooCostly : the matrices would take more memory than a run may
    """
    for k in _systems(scene, spec):
        scene.system(k)  # whose free motions ``Scene.warnings`` looks at for instability
    scene, (poles, receptances) = solve_accurately(
        scene, partial(_errors, spec), lambda found: max(RESPONSES * found[0], found[1])
    )
    whole = Joined.of(scene, _systems(scene, spec))
    stiffness, damping, motion = whole.stiffness, whole.damping, _motion(whole, spec)
    rows = few_rows(scene)
    frequency = _frequencies(scene, spec, rows)
    each = [_receptances(stiffness[k], damping[k], motion, 2j * math.pi * frequency) for k in rows]
    return MatricesResult(
        speed=scene.speed,
        row=np.arange(1, motion.shape[1] + 1),
        column=np.arange(1, motion.shape[1] + 1),
        port=tuple(str(port) for port in spec.ports),
        shown_speed=scene.speed[scene.usable[rows]],
        frequency=frequency,
        outcome=scene.outcome,
        stiffness=scene.scattered(stiffness),
        damping=scene.scattered(damping),
        gyroscopic=whole.gyroscopic,
        motion=motion,
        receptance=np.array([np.diagonal(one, axis1=1, axis2=2).T for one in each]),
        max_frequency=spec.max_frequency,
        frequency_error=poles,
        receptance_error=receptances,
        error_asked=response_accuracy(scene),
    )


def _systems(scene: Scene, spec: MatricesSpec) -> list[int]:
    """Subsystems that some port moves."""
    return sorted({scene.owner(port.point, port.direction) for port in spec.ports})


def _motion(whole: Joined, spec: MatricesSpec) -> Array:
    return whole.displaced((port.point, port.direction) for port in spec.ports)


def _errors(spec: MatricesSpec, scene: Scene) -> tuple[float, float]:
    """Of poles, relative, and of receptances over the largest one of their ports; NaN where none
    are sought."""
    if not scene.checks.wanted:
        return math.nan, math.nan
    highest = 2.0 * math.pi * spec.max_frequency
    omega = highest * np.arange(1, GRID + 1) / GRID

    def between_ports(one: Scene, rows: Indices) -> Complex:
        whole = Joined.of(one, _systems(one, spec), rows)
        motion, s = _motion(whole, spec), omega * (1j + BESIDE)
        matrices = zip(whole.stiffness, whole.damping, strict=True)
        found = np.array([_receptances(k, c, motion, s) for k, c in matrices])
        return found.reshape(len(found), GRID, -1)

    return _pole_error(scene, spec, highest), float(changes(scene, between_ports, 2, AT_REST).max())


def _pole_error(scene: Scene, spec: MatricesSpec, highest: float) -> float:
    """How far poles up to ``highest`` [rad/s] are from the nearest ones of the finer model, and
    these, somewhat lower, from the nearest of this one."""
    rows, worst = few_rows(scene), 0.0
    for k in _systems(scene, spec):
        models = [one.system_at(k, rows).pole for one in (scene, scene.refined)]
        for both in zip(*models, strict=True):
            known = [pole[np.isfinite(pole)] for pole in both]
            for (here, there), part in zip((known, known[::-1]), (1.0, 0.9), strict=True):
                low = here[np.abs(here) <= part * highest]
                away = np.abs(low[:, None] - there).min(axis=1, initial=math.inf)
                change = away / np.maximum(np.abs(low), SLOW * highest)
                worst = max(worst, float(change.max(initial=0.0)))
    return worst


def _frequencies(scene: Scene, spec: MatricesSpec, rows: Indices) -> Array:
    """Up to the highest one [Hz], evenly and about the poles of some ``rows``, from a tenth of the
    slowest on; without poles at zero of what is free."""
    even = np.linspace(0.0, spec.max_frequency, POINTS + 1)[1:]
    poles = [scene.system_at(k, rows).pole.ravel() for k in _systems(scene, spec)]
    pole = np.concatenate(poles) / (2.0 * math.pi)
    pole = pole[np.abs(pole) > FREE * spec.max_frequency]
    width = np.abs(pole.real)
    sharp = width < NARROW * np.abs(pole.imag)
    width = np.where(sharp, NARROW * np.abs(pole.imag), width)[:, None]
    about = (pole.imag[:, None] + width * ABOUT)[~sharp[:, None] | (ABOUT != 0.0)]
    least = 0.1 * min(10.0 * even[0], float(np.abs(pole).min(initial=math.inf)))
    every = np.unique(np.concatenate([[least], even, about]))
    return every[(every >= least) & (every <= spec.max_frequency)]


def _receptances(stiffness: Array, damping: Array, motion: Array, s: Any) -> Complex:
    """L (K + s C + s²)⁻¹ Lᵀ (s, ports, ports); NaN on a pole."""
    unit, found = np.eye(len(stiffness)), np.empty((len(s), *[len(motion)] * 2), dtype=complex)
    for k, one in enumerate(s):
        try:
            found[k] = motion @ np.linalg.solve(stiffness + one * damping + one**2 * unit, motion.T)
        except np.linalg.LinAlgError:
            found[k] = complex(np.nan, np.nan)
    return found
