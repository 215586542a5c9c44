"""Damped eigenfrequencies over speed, each mode followed by its shape."""

from __future__ import annotations

import math

import numpy as np

from rotordyn.analyses.campbell.passing import passing
from rotordyn.analyses.campbell.result import CampbellResult, TurningCampbellResult
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.campbell.threshold import stability_threshold
from rotordyn.arrays import Array, Complex
from rotordyn.equation.dofs import DIRECTIONS, position
from rotordyn.modes.branches import MOTIONS, Branch, branches_of
from rotordyn.modes.character import across, characters, rigid_share
from rotordyn.modes.criticals import critical_speeds
from rotordyn.modes.errors import mode_errors
from rotordyn.modes.excitation import excited_by, exciting
from rotordyn.modes.names import named
from rotordyn.modes.overdamped import OVERDAMPED
from rotordyn.numerics.products import times
from rotordyn.scene.formulation import ROTATING, require_axisymmetric
from rotordyn.scene.scene import Scene

TIE = 1e-9  # of the largest displacement of a shape: less is rounding


def solve(scene: Scene, spec: CampbellSpec) -> CampbellResult:
    """Solve bending, axial and torsion modes up to ``spec.max_frequency``, of a model refined to
    the required accuracy (``refinement``).

    Raises
    ------
    InvalidInput : the rotating frame, and anisotropic supports
    """
    rotating = scene.conditions.formulation == ROTATING
    if rotating:
        require_axisymmetric(scene)
    highest = 2.0 * math.pi * spec.max_frequency
    seen = 2.0 * math.pi * scene.fineness.frequency if rotating else highest

    def modes(model: Scene) -> tuple[list[Branch], tuple[str, ...]]:
        candidates = branches_of(model, seen)
        return named([b for b in candidates if not rotating or _within(model, b, highest)])

    scene, (branches, names), errors = mode_errors(scene, highest, modes)
    ends = sorted({0, len(scene.usable) - 1}) if spec.shapes else []
    lines = exciting(scene.spindle.ratios, spec.engine_orders)
    criticals = critical_speeds(scene, highest, lines, branches, names)
    threshold = stability_threshold(scene, highest, branches, names)
    shape = (len(scene.usable), len(branches))
    pole = np.array([b.pole for b in branches], dtype=complex).reshape(shape[::-1]).T
    degree = _table([b.degree for b in branches], shape)
    linears = [scene.system(b.subsystem).linear for b in branches]
    rigid = [*map(rigid_share, linears, branches)]
    frequency = pole.imag
    if rotating:
        speed = scene.speed[scene.usable]
        frequency = _table([b.frequency_in_frame(speed) for b in branches], shape)
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = scene.scattered(-pole.real / np.abs(pole))
        error = errors.frequency * np.where(frequency == pole.imag, 1.0, np.abs(pole) / frequency)
    counts = [scene.system(k).free_count for k in scene.with_motions(MOTIONS)]
    free = np.sum([np.zeros(len(scene.usable)), *counts], axis=0)  # rigid-body eigenvalues
    defects, defect_frequency = passing(scene, spec.bearing_frequencies)
    result_type = TurningCampbellResult if rotating else CampbellResult
    return result_type(
        speed=scene.speed,
        mode=names,
        node=scene.mesh.stations,
        rotor=tuple(scene.spindle.ratios),
        dof=DIRECTIONS,
        shape_speed=scene.speed[scene.usable][ends],
        critical=tuple(c.mode for c in criticals),
        engine_order=np.array(spec.engine_orders, dtype=float),
        outcome=scene.outcome,
        frequency=scene.scattered(frequency / (2.0 * math.pi)),
        frequency_error=scene.scattered(error),
        damping_error=scene.scattered(errors.damping),
        pole=scene.scattered(pole),
        max_frequency=spec.max_frequency,
        unconverged=errors.unconverged,
        stopped=scene.scattered(scene.stopped.sum(axis=1).astype(float)),
        free=scene.scattered(free),
        node_rotor=scene.mesh.rotor,
        speed_ratio=np.array(list(scene.spindle.ratios.values())),
        damping_ratio=ratio,
        overdamped=ratio > OVERDAMPED,
        followed=~np.isnan(scene.scattered(pole)),
        decrement=scene.scattered(-2.0 * math.pi * pole.real / np.abs(pole.imag)),
        whirl=scene.scattered(_table([b.whirl for b in branches], shape)),
        whirl_degree=scene.scattered(degree),
        rigid_share=scene.scattered(_table(rigid, shape)),
        kind=tuple(b.kind for b in branches),
        character=characters(linears, branches, rigid),
        excited_by=tuple(_excited_by(scene, b) for b in branches),
        shape=_shapes(scene, branches, ends),
        stability_threshold=threshold.speed,
        threshold_is_bound=threshold.is_bound,
        unstable_mode=threshold.name,
        critical_speed=np.array([c.speed for c in criticals]),
        critical_rotor=tuple(c.line.rotor for c in criticals),
        critical_order=np.array([c.line.order for c in criticals]),
        critical_kind=tuple(c.kind for c in criticals),
        critical_whirl=tuple(c.whirl for c in criticals),
        critical_damping=np.array([c.damping_ratio for c in criticals]),
        critical_excited=np.array([c.excited for c in criticals], dtype=bool),
        passing=defects,
        passing_frequency=defect_frequency,
    )


def _within(scene: Scene, branch: Branch, highest: float) -> bool:
    """Return whether a mode is below the ``highest`` angular frequency [rad/s] in some frame, at
    some speed."""
    rotating = branch.frequency_in_frame(scene.speed[scene.usable])
    both = np.concatenate([rotating, np.abs(branch.track.pole.imag)])
    return bool(np.nanmin(both) <= highest)


def _excited_by(scene: Scene, branch: Branch) -> str:
    whirl = "forward" if np.nansum(branch.degree) > 0.0 else "backward"
    linear = scene.system(branch.subsystem).linear
    bends = across(linear, branch.vector)
    return excited_by(branch.kind, whirl, axisymmetric=linear.axisymmetric, across=bends)


def _table(rows: list[Array], shape: tuple[int, int]) -> Array:
    """Return values of the branches as (usable, modes)."""
    return np.array(rows, dtype=float).reshape(shape[::-1]).T


def _shapes(scene: Scene, branches: list[Branch], ends: list[int]) -> Complex:
    """Return node displacements (ends, modes, nodes, 6), scaled so that the largest translation, in
    torsion the largest twist, is 1 and real; zero in modes of a housing without the rotor."""
    shape = (len(ends), len(branches), len(scene.mesh.stations), 6)
    shapes = np.full(shape, complex(np.nan, np.nan))
    for end, row in enumerate(ends):
        for k, branch in enumerate(branches):
            if branch.column[row] >= 0:
                motion = scene.system(branch.subsystem).linear.motion
                u = times(motion, branch.vector[row][:, None])[..., 0]
                pool = u[:, position("thx")] if branch.kind == "torsion" else u[:, :3]
                size = np.abs(pool).ravel()  # on a circle y and z are equal but for rounding: y
                largest = int((size >= (1.0 - TIE) * size.max()).argmax())
                shapes[end, k] = u / (pool.flat[largest] or 1.0)
    return shapes
