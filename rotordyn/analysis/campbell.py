"""Damped eigenfrequencies over speed, each mode followed by its shape."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.accuracy import frequency_error
from rotordyn.analysis.branches import Branch, branches_of, home_of
from rotordyn.analysis.certificate import count
from rotordyn.analysis.character import character, rigid_share
from rotordyn.analysis.criticals import critical_speeds
from rotordyn.analysis.formulation import ROTATING
from rotordyn.analysis.mode_names import named
from rotordyn.analysis.results import CampbellResult, TurningCampbellResult
from rotordyn.analysis.results.modes import CREEPING
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.shapes import both_planes, scaled
from rotordyn.analysis.specs import CampbellSpec
from rotordyn.analysis.threshold import stability_threshold
from rotordyn.elements.node import FREEDOMS
from rotordyn.errors import InvalidInput
from rotordyn.system.lateral import LateralSystem

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
FINER = 2  # times, at most, that it is solved again from more vibrations of the free rotor


def answer(scene: Scene, spec: CampbellSpec) -> CampbellResult:
    """Bending, axial and torsion modes up to ``spec.max_frequency``.

    Where their number is not proven, again from more free-free modes, ``FINER`` times at most;
    where frequencies are told to be farther off than asked for, once.
    """
    found = _answer(scene, spec)
    for attempt in range(FINER):
        if found.certified[scene.usable].all() and (attempt or _accurate(scene, found)):
            break
        scene = scene.beyond(2.0)
        try:
            found = _answer(scene, spec)
        except InvalidInput:  # more than its matrices hold
            break
    return found


def _accurate(scene: Scene, found: CampbellResult) -> bool:
    """True where every frequency of the band that swings is told to be as good as asked for."""
    asked = scene.fineness.accuracy
    swinging = ~found.creeping & (found.damping_ratio <= CREEPING)
    inside = swinging & (found.frequency <= found.max_frequency)
    return asked is None or not (found.frequency_error[inside] > asked).any()


def _why_not(scene: Scene) -> str:
    """What in the machine keeps the number of modes from being proven; "" if nothing special."""
    return "loss factors" if scene.spindle.hysteretic else ""


def _answer(scene: Scene, spec: CampbellSpec) -> CampbellResult:
    branches, names = named(branches_of(scene, spec))
    ends = sorted({0, len(scene.usable) - 1}) if spec.shapes else []
    criticals = critical_speeds(scene, spec, branches, names)
    threshold, growing = stability_threshold(scene, spec, branches, names)
    shape = (len(scene.usable), len(branches))
    pole = np.array([b.pole for b in branches], dtype=complex).reshape(shape[::-1]).T
    rigid = [rigid_share(scene.vibration(b.kind)[0], b) for b in branches]
    certified, below, seen = _counted(scene, spec, branches)
    kind = TurningCampbellResult if scene.conditions.formulation == ROTATING else CampbellResult
    return kind(
        speed=scene.speed,
        mode=names,
        node=scene.mesh.stations,
        rotor=tuple(scene.spindle.ratios),
        dof=FREEDOMS,
        shape_speed=scene.speed[scene.usable][ends],
        critical=tuple(c.mode for c in criticals),
        engine_order=np.array(spec.engine_orders, dtype=float),
        outcome=scene.outcome,
        frequency=scene.scattered(_seen(scene, branches)),
        frequency_error=scene.scattered(_errors(scene, branches)),
        max_frequency=spec.max_frequency,
        resolved_frequency=scene.resolved_frequency,
        free=scene.scattered(_free(scene)),
        node_rotor=scene.mesh.rotor,
        speed_ratio=np.array(list(scene.spindle.ratios.values())),
        certified=certified,
        no_proof="" if certified[scene.usable].all() else _why_not(scene),
        modes_below=scene.scattered(below),
        modes_found=scene.scattered(seen),
        damping_ratio=scene.scattered(-pole.real / np.abs(pole)),
        decrement=scene.scattered(-2.0 * math.pi * pole.real / np.abs(pole.imag)),
        whirl=scene.scattered(_table([b.whirl for b in branches], shape)),
        whirl_degree=scene.scattered(_table([b.degree for b in branches], shape)),
        rigid_share=scene.scattered(_table(rigid, shape)),
        kind=tuple(b.kind for b in branches),
        character=tuple(character(b, own) for b, own in zip(branches, rigid, strict=True)),
        shape=_shapes(scene, branches, ends),
        stability_threshold=threshold,
        first_to_grow=growing,
        critical_speed=np.array([c.speed for c in criticals]),
        critical_rotor=tuple(c.line.rotor for c in criticals),
        critical_order=np.array([c.line.order for c in criticals]),
        critical_kind=tuple(c.kind for c in criticals),
        critical_whirl=tuple(c.whirl for c in criticals),
        critical_damping=np.array([c.damping_ratio for c in criticals]),
        critical_excited=np.array([c.excited for c in criticals], dtype=bool),
    )


def _table(rows: list[Array], shape: tuple[int, int]) -> Array:
    """Values of the branches (usable, modes)."""
    return np.array(rows, dtype=float).reshape(shape[::-1]).T


def _seen(scene: Scene, branches: list[Branch]) -> Array:
    """Damped frequencies (usable, modes) [Hz] in the frame of the formulation."""
    frames = [scene.bending.frame if b.kind == "bending" else 0.0 for b in branches]
    seen = [np.abs(b.pole.imag - frame) for b, frame in zip(branches, frames, strict=True)]
    return np.array(seen).reshape(len(branches), len(scene.usable)).T / (2.0 * math.pi)


def _errors(scene: Scene, branches: list[Branch]) -> Array:
    """Estimated relative errors of the poles (usable, modes)."""
    errors = np.zeros((len(scene.usable), len(branches)))
    homes = [home_of(scene, b.kind) for b in branches]
    for motion in set(homes):
        own = [k for k, name in enumerate(homes) if name == motion]
        columns = np.stack([branches[k].column for k in own], axis=1)
        errors[:, own] = frequency_error(scene, motion, columns)
    return errors


def _free(scene: Scene) -> Array:
    """How many eigenvalues (usable,) are those of motions that nothing holds."""
    count = np.zeros(len(scene.usable))
    for home in {home_of(scene, motion) for motion in ("bending", "axial", "torsion")}:
        system, found = scene.vibration(home)
        turned = system.frame if isinstance(system, LateralSystem) else None
        count += found.at_rest(turned).sum(axis=-1)
    return count


def _counted(
    scene: Scene, spec: CampbellSpec, branches: list[Branch]
) -> tuple[NDArray[np.bool_], Array, Array]:
    """Where the number of modes is proven and found (speeds,); that number, NaN where there is no
    proof, and how many branches are among them (usable,)."""
    highest = 2.0 * math.pi * spec.max_frequency
    homes = {kind: home_of(scene, kind) for kind in ("bending", "axial", "torsion")}
    proven = np.ones(len(scene.usable), dtype=bool)
    below, seen = np.zeros((2, len(scene.usable)))
    for home in set(homes.values()):
        own = [b for b in branches if homes[b.kind] == home]
        known = count(scene, home, highest)
        number = _within(own, highest, known.radius)
        proven = proven & known.proven
        below, seen = below + known.number, seen + number
    certified = np.zeros(len(scene.speed), dtype=bool)
    certified[scene.usable] = proven & (below == seen)
    return certified, np.where(proven, below, np.nan), seen


def _within(branches: list[Branch], highest: float, radius: Array) -> Array:
    """How many branches swing at ``highest`` [rad/s] at most, their poles in discs (usable,)."""
    inside = [(np.abs(b.pole.imag) <= highest) & (np.abs(b.pole) < radius) for b in branches]
    return np.sum(inside, axis=0) + np.zeros(len(radius))


def _shapes(scene: Scene, branches: list[Branch], ends: list[int]) -> Complex:
    """Node displacements (ends, modes, nodes, 6), each scaled to a largest value of 1."""
    shape = (len(ends), len(branches), len(scene.mesh.stations), 6)
    shapes = np.full(shape, complex(np.nan, np.nan))
    motion: dict[str, Array] = {}
    for place, row in enumerate(ends):
        for k, branch in enumerate(branches):
            if branch.column[row] < 0:
                continue
            system, vector = scene.vibration(branch.kind)[0], branch.vector[row]
            if isinstance(system, LateralSystem) and system.isotropic:
                vector = both_planes(vector, branch.pole[row].imag)
            if branch.kind not in motion:
                motion[branch.kind] = system.motion
            moved = motion[branch.kind] @ np.stack([vector.real, vector.imag], axis=-1)
            shapes[place, k] = scaled(moved[..., 0] + 1j * moved[..., 1], branch.kind)
    return shapes
