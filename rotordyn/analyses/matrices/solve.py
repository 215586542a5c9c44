"""The equation of motion of all subsystems that the ports move, at every speed.

The same coordinates serve all speeds. Their error is estimated by a finer model, at the first and
the last speed: by its poles, and by receptances between the ports. These are taken off the
imaginary axis, at s = ω (i + 0.05), where no peak is higher than with 5 % of damping.

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
BESIDE = 0.05  # damping ratio added to these receptances
SLOW = 1e-3  # of the highest frequency, to which the error of slower poles relates
POINTS = 200  # of a receptance from zero to the highest frequency, besides those about its poles
ABOUT = np.array([-20.0, -6.0, -2.5, -1.0, -0.4, 0.0, 0.4, 1.0, 2.5, 6.0, 20.0])  # half widths
FREE = 1e-5  # of the highest frequency: a slower pole is that of a rigid-body mode
NARROW = 1e-6  # of the frequency: half width of a peak; narrower ones are drawn without top


def solve(scene: Scene, spec: MatricesSpec) -> MatricesResult:
    """Matrices and receptances at every speed with a state.

    Raises
    ------
    NoSolution : no speed has one
    TooCostly : the matrices would take more memory than a run may
    """
    for k in _systems(scene, spec):
        scene.system(k)  # ``Scene.warnings`` looks for instability in solved systems only
    scene, (poles, receptances) = solve_accurately(
        scene, partial(_errors, spec), lambda errors: max(RESPONSES * errors[0], errors[1])
    )
    joined = Joined.of(scene, _systems(scene, spec))
    stiffness, damping, motion = joined.stiffness, joined.damping, _motion(joined, spec)
    rows = few_rows(scene)
    frequency = _frequencies(scene, spec, rows)
    direct = [
        _receptances(stiffness[k], damping[k], motion, 2j * math.pi * frequency) for k in rows
    ]
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
        gyroscopic=joined.gyroscopic,
        motion=motion,
        receptance=np.array([np.diagonal(values, axis1=1, axis2=2).T for values in direct]),
        max_frequency=spec.max_frequency,
        frequency_error=poles,
        receptance_error=receptances,
        error_asked=response_accuracy(scene),
    )


def _systems(scene: Scene, spec: MatricesSpec) -> list[int]:
    """Subsystems that some port moves."""
    return sorted({scene.owner(port.point, port.direction) for port in spec.ports})


def _motion(joined: Joined, spec: MatricesSpec) -> Array:
    return joined.displaced((port.point, port.direction) for port in spec.ports)


def _errors(spec: MatricesSpec, scene: Scene) -> tuple[float, float]:
    """Estimated errors of poles, relative, and of receptances, over the largest one of their ports;
    NaN without error checks."""
    if not scene.checks.wanted:
        return math.nan, math.nan
    highest = 2.0 * math.pi * spec.max_frequency
    omega = highest * np.arange(1, GRID + 1) / GRID

    def between_ports(model: Scene, rows: Indices) -> Complex:
        joined = Joined.of(model, _systems(model, spec), rows)
        motion, s = _motion(joined, spec), omega * (1j + BESIDE)
        matrices = zip(joined.stiffness, joined.damping, strict=True)
        receptances = np.array([_receptances(k, c, motion, s) for k, c in matrices])
        return receptances.reshape(len(receptances), GRID, -1)

    return _pole_error(scene, spec, highest), float(changes(scene, between_ports, 2, AT_REST).max())


def _pole_error(scene: Scene, spec: MatricesSpec, highest: float) -> float:
    """Largest relative distance of poles up to ``highest`` [rad/s] from the nearest of the finer
    model, and of its poles, up to 0.9 of that, from the nearest of this model."""
    rows, worst = few_rows(scene), 0.0
    for k in _systems(scene, spec):
        models = [model.system_at(k, rows).pole for model in (scene, scene.refined)]
        for at_speed in zip(*models, strict=True):
            finite = [pole[np.isfinite(pole)] for pole in at_speed]
            for (poles, reference), part in zip((finite, finite[::-1]), (1.0, 0.9), strict=True):
                low = poles[np.abs(poles) <= part * highest]
                distance = np.abs(low[:, None] - reference).min(axis=1, initial=math.inf)
                change = distance / np.maximum(np.abs(low), SLOW * highest)
                worst = max(worst, float(change.max(initial=0.0)))
    return worst


def _frequencies(scene: Scene, spec: MatricesSpec, rows: Indices) -> Array:
    """Frequencies up to the highest one [Hz], even and about the poles at ``rows``, from a tenth of
    the slowest pole on; rigid-body poles are excluded."""
    even = np.linspace(0.0, spec.max_frequency, POINTS + 1)[1:]
    poles = [scene.system_at(k, rows).pole.ravel() for k in _systems(scene, spec)]
    pole = np.concatenate(poles) / (2.0 * math.pi)
    pole = pole[np.abs(pole) > FREE * spec.max_frequency]
    width = np.abs(pole.real)
    sharp = width < NARROW * np.abs(pole.imag)
    width = np.where(sharp, NARROW * np.abs(pole.imag), width)[:, None]
    about = (pole.imag[:, None] + width * ABOUT)[~sharp[:, None] | (ABOUT != 0.0)]
    least = 0.1 * min(10.0 * even[0], float(np.abs(pole).min(initial=math.inf)))
    frequency = np.unique(np.concatenate([[least], even, about]))
    return frequency[(frequency >= least) & (frequency <= spec.max_frequency)]


def _receptances(stiffness: Array, damping: Array, motion: Array, s: Any) -> Complex:
    """L (K + s C + s²)⁻¹ Lᵀ (s, ports, ports); NaN on a pole."""
    unit, h = (np.eye(len(stiffness)), np.empty((len(s), *[len(motion)] * 2), dtype=complex))
    for k, p in enumerate(s):
        try:
            h[k] = motion @ np.linalg.solve(stiffness + p * damping + p**2 * unit, motion.T)
        except np.linalg.LinAlgError:
            h[k] = complex(np.nan, np.nan)
    return h
