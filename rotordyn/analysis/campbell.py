"""Damped eigenfrequencies over speed, each mode followed by its shape.

A mode of motions that supports couple is named after the one with the largest share of its kinetic
energy, on the mean of all speeds: of two modes that veer, what each is over most of the range.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from rotordyn.analysis.accuracy import frequency_error
from rotordyn.analysis.certificate import Count, count, swings
from rotordyn.analysis.exact_bending import ExactBending, ExactModes
from rotordyn.analysis.formulation import ROTATING
from rotordyn.analysis.results import CampbellResult, TurningCampbellResult
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.shapes import both_planes, scaled
from rotordyn.analysis.specs import CampbellSpec
from rotordyn.elements.node import FREEDOMS
from rotordyn.numerics.crossing import zero_crossings
from rotordyn.numerics.follow import follow
from rotordyn.numerics.modes import Modes
from rotordyn.system.coupled import CoupledSystem
from rotordyn.system.lateral import LateralSystem
from rotordyn.system.longitudinal import RodSystem

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
FINER = 2  # times that more modes are tried where the count is not proven
MARGIN = 1.5  # modes up to this multiple of the highest frequency are followed


@dataclass(frozen=True, slots=True)
class Branch:
    """One mode over the usable speeds: ``pole``, ``whirl``, column in the modes (−1: lost).

    ``vector`` (speeds, n): its displacements in the coordinates of its system.
    Poles are those of the fixed frame, whatever the formulation.
    """

    kind: str
    pole: Complex
    whirl: Array
    column: NDArray[np.intp]
    vector: Complex

    @property
    def frequency(self) -> Array:
        """|Im pole| / 2π [Hz], NaN where the mode is lost."""
        return np.abs(self.pole.imag) / (2.0 * math.pi)

    @property
    def born(self) -> int:
        """First speed at which it is there."""
        return int((self.column >= 0).argmax())


def answer(scene: Scene, spec: CampbellSpec) -> CampbellResult:
    """Bending, axial and torsion modes up to ``spec.max_frequency``.

    Where their number is not proven, once more from more free-free modes.
    """
    found = _answer(scene, spec)
    for _ in range(FINER):
        if found.certified[scene.usable].all():
            break
        scene = scene.beyond(2.0)
        found = _answer(scene, spec)
    return found


def _answer(scene: Scene, spec: CampbellSpec) -> CampbellResult:
    branches = _coupled(scene, spec)
    for motion, alone in (("bending", _bending), ("axial", _axial), ("torsion", _torsion)):
        if motion not in scene.coupled_motions:
            branches += alone(scene, spec)
    branches = [b for b in branches if np.nanmin(b.frequency) <= spec.max_frequency]
    branches.sort(key=_place)
    names = _names(branches)
    ends = sorted({0, len(scene.usable) - 1}) if spec.shapes else []
    criticals = _criticals(scene, branches, names)
    shape = (len(scene.usable), len(branches))
    pole = np.array([b.pole for b in branches], dtype=complex).reshape(shape[::-1]).T
    whirl = np.array([b.whirl for b in branches]).reshape(shape[::-1]).T
    certified, below, seen = _counted(scene, spec, branches)
    kind = TurningCampbellResult if scene.conditions.formulation == ROTATING else CampbellResult
    return kind(
        speed=scene.speed,
        mode=names,
        node=scene.mesh.x,
        dof=FREEDOMS,
        shape_speed=scene.speed[scene.usable][ends],
        critical=tuple(name for name, _ in criticals),
        outcome=scene.outcome,
        frequency=scene.scattered(_seen(scene, branches)),
        frequency_error=scene.scattered(_errors(scene, branches)),
        resolved_frequency=scene.resolved_frequency,
        free=scene.scattered(_free(scene)),
        certified=certified,
        modes_below=scene.scattered(below),
        modes_found=scene.scattered(seen),
        damping_ratio=scene.scattered(-pole.real / np.abs(pole)),
        whirl=scene.scattered(whirl),
        kind=tuple(b.kind for b in branches),
        shape=_shapes(scene, branches, ends),
        critical_speed=np.array([speed for _, speed in criticals]),
    )


def _seen(scene: Scene, branches: list[Branch]) -> Array:
    """Damped frequencies (usable, modes) [Hz] in the frame of the formulation."""
    frames = [scene.bending.frame if b.kind == "bending" else 0.0 for b in branches]
    seen = [np.abs(b.pole.imag - frame) for b, frame in zip(branches, frames, strict=True)]
    return np.array(seen).reshape(len(branches), len(scene.usable)).T / (2.0 * math.pi)


def _errors(scene: Scene, branches: list[Branch]) -> Array:
    """Estimated relative errors of the poles (usable, modes); none by the exact shaft."""
    errors = np.zeros((len(scene.usable), len(branches)))
    homes = [_home(scene, b.kind) for b in branches]
    for motion in set(homes):
        own = [k for k, name in enumerate(homes) if name == motion]
        columns = np.stack([branches[k].column for k in own], axis=1)
        exact = motion == "bending" and scene.bends_exactly
        errors[:, own] = (
            np.where(columns < 0, np.nan, 0.0) if exact else frequency_error(scene, motion, columns)
        )
    return errors


def _free(scene: Scene) -> Array:
    """How many eigenvalues (usable,) are those of motions that nothing holds."""
    count = np.zeros(len(scene.usable))
    for home in {_home(scene, motion) for motion in ("bending", "axial", "torsion")}:
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
    homes = {kind: _home(scene, kind) for kind in ("bending", "axial", "torsion")}
    proven = np.ones(len(scene.usable), dtype=bool)
    below, seen = np.zeros((2, len(scene.usable)))
    for home in set(homes.values()):
        own = [b for b in branches if homes[b.kind] == home]
        if home == "bending" and scene.bends_exactly:
            number = _within(own, highest, np.full(len(proven), np.inf))
            known = Count(number, proven, number)
        else:
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


def _home(scene: Scene, kind: str) -> str:
    """A motion whose system a mode of this kind was found in, the same for all coupled ones."""
    coupled = scene.coupled_motions
    return min(coupled) if kind in coupled else kind


def _bending(scene: Scene, spec: CampbellSpec) -> list[Branch]:
    found: Modes | ExactModes = scene.bending_modes
    if scene.bends_exactly:
        highest = 2.0 * math.pi * MARGIN * spec.max_frequency
        exactly = partial(scene.exact.modes, scene.bending_modes, highest)
        found = scene.timed("exact bending modes", exactly)
    frame = scene.bending.frame
    free = found.at_rest(frame)
    found = dataclasses.replace(found, pole=found.pole + 1j * frame[:, None])
    if not scene.bending.isotropic:
        branches = _followed("bending", found, free, spec, +1.0)
        return [replace(b, whirl=_whirl_of_planes(b.vector, b.column)) for b in branches]
    return [
        replace(b, whirl=np.where(b.column < 0, np.nan, side))
        for side in (-1.0, +1.0)
        for b in _followed("bending", found, free, spec, side)
    ]


def _axial(scene: Scene, spec: CampbellSpec) -> list[Branch]:
    found = scene.axial_modes
    return _followed("axial", found, found.at_rest(), spec, +1.0)


def _torsion(scene: Scene, spec: CampbellSpec) -> list[Branch]:
    once, speeds = scene.torsion_modes, len(scene.usable)
    fields = (getattr(once, f.name) for f in dataclasses.fields(once))
    every = Modes(*(np.repeat(values, speeds, axis=0) for values in fields))
    return _followed("torsion", every, every.at_rest(), spec, +1.0)


def _coupled(scene: Scene, spec: CampbellSpec) -> list[Branch]:
    """The modes of the motions that supports couple."""
    if not scene.coupled_motions:
        return []
    branches, places = [], scene.coupled.places
    found = scene.coupled_modes
    for branch in _followed("", found, found.at_rest(), spec, +1.0):
        squares = np.abs(branch.vector[branch.column >= 0]) ** 2
        squares = squares / squares.sum(axis=1, keepdims=True)
        energy = {motion: squares[:, own].sum() for motion, own in places.items()}
        kind = max(energy, key=lambda motion: float(energy[motion]))
        whirl = branch.whirl
        if kind == "bending":
            whirl = _whirl_of_planes(branch.vector[:, places[kind]], branch.column)
        branches.append(replace(branch, kind=kind, whirl=whirl))
    return branches


def _followed(
    kind: str,
    found: Modes | ExactModes,
    free: NDArray[np.bool_],
    spec: CampbellSpec,
    side: float,
) -> list[Branch]:
    """Branches of the modes that turn with e^(i·side·ω t), ω > 0, but the ``free`` ones."""
    ceiling = 2.0 * math.pi * MARGIN * spec.max_frequency
    chosen = []
    for pole, idle in zip(found.pole, free, strict=True):
        turning = side * pole.imag
        keep = swings(pole, turning) & (turning < ceiling)
        columns = np.flatnonzero(keep & ~idle)
        chosen.append(columns[np.argsort(turning[columns])])
    vectors = [found.vector[s][:, c] for s, c in enumerate(chosen)]
    values = [side * found.pole[s].imag[c] for s, c in enumerate(chosen)]
    path = follow(vectors, values)
    branches = []
    for mode in range(path.shape[1]):
        column = np.array(
            [c[p] if p >= 0 else -1 for c, p in zip(chosen, path[:, mode], strict=True)]
        )
        pole = found.pole[np.arange(len(column)), column]
        pole = np.where(column >= 0, pole, complex(np.nan, np.nan))
        vector = found.vector[np.arange(len(column)), :, column]
        branches.append(Branch(kind, pole, np.where(column < 0, np.nan, 0.0), column, vector))
    return branches


def _whirl_of_planes(vector: Complex, column: NDArray[np.intp]) -> Array:
    """+1 forward, −1 backward, 0 planar: which circular part of y, z dominates."""
    y, z = np.split(vector, 2, axis=1)
    forward, backward = np.abs(y + 1j * z), np.abs(y - 1j * z)
    difference = (forward**2 - backward**2).sum(axis=1)
    share = difference / (forward**2 + backward**2).sum(axis=1)
    return np.where(column < 0, np.nan, np.where(np.abs(share) < 1e-6, 0.0, np.sign(share)))


def _place(branch: Branch) -> tuple[str, float, float]:
    """Bending, axial, torsion; from below; of twins the backward one first."""
    kind = {"bending": "0", "axial": "1", "torsion": "2"}[branch.kind]
    first = branch.born
    return kind, float(f"{branch.frequency[first]:.8g}"), float(branch.whirl[first])


def _names(branches: list[Branch]) -> tuple[str, ...]:
    """Number the modes of each kind (and whirl, where it is one throughout) from below."""
    counts: dict[str, int] = {}
    names = []
    paired = all(np.unique(b.whirl[b.column >= 0]).size == 1 for b in branches)
    for branch in branches:
        whirl = {1.0: " forward", -1.0: " backward"}.get(float(branch.whirl[branch.born]), "")
        family = branch.kind + (whirl if paired else "")
        counts[family] = counts.get(family, 0) + 1
        names.append(f"{branch.kind} {counts[family]}{whirl if paired else ''}")
    return tuple(names)


def _criticals(
    scene: Scene, branches: list[Branch], names: tuple[str, ...]
) -> list[tuple[str, float]]:
    """Speeds where a bending mode that unbalance can excite meets the 1× line, ascending."""
    found = []
    even = "bending" not in scene.coupled_motions and scene.bending.isotropic
    for branch, name in zip(branches, names, strict=True):
        excited = branch.kind == "bending" and not (even and branch.whirl[branch.born] < 0)
        if excited:
            turning = scene.scattered(np.abs(branch.pole.imag))
            crossings = zero_crossings(scene.speed, turning - scene.speed)
            found += [(name, zero) for zero in crossings]
    return sorted(found, key=lambda pair: pair[1])


def _shapes(scene: Scene, branches: list[Branch], ends: list[int]) -> Complex:
    """Node displacements (ends, modes, nodes, 6), each scaled to a largest value of 1."""
    shape = (len(ends), len(branches), scene.mesh.nodes, 6)
    shapes = np.full(shape, complex(np.nan, np.nan))
    for place, row in enumerate(ends):
        for k, branch in enumerate(branches):
            if branch.column[row] < 0:
                continue
            system, vector = _system(scene, branch.kind), branch.vector[row]
            if isinstance(system, LateralSystem | ExactBending) and system.isotropic:
                vector = both_planes(vector, branch.pole[row].imag)
            shapes[place, k] = scaled(system.motion @ vector, branch.kind)
    return shapes


def _system(scene: Scene, kind: str) -> LateralSystem | RodSystem | CoupledSystem | ExactBending:
    """Whose coordinates the vectors of a kind of motion are."""
    if kind == "bending" and scene.bends_exactly:
        return scene.exact
    return scene.vibration(kind)[0]
