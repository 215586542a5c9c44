"""Modes over speed: those of bending, axial motion and torsion, each followed by its shape.

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

from rotordyn.analysis.certificate import swings
from rotordyn.analysis.exact_bending import ExactModes
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.specs import CampbellSpec
from rotordyn.numerics.follow import follow
from rotordyn.numerics.modes import Modes

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
MARGIN = 1.5  # modes up to this multiple of the highest frequency are followed
PLANAR = 1e-6  # whirl degree below which a motion is straight


@dataclass(frozen=True, slots=True)
class Branch:
    """One mode over the usable speeds: ``pole``, whirl ``degree``, column in the modes (−1: lost).

    ``degree``: share of the kinetic energy in forward circular motion less that in backward.
    ``vector`` (speeds, n): its displacements in the coordinates of its system.
    Poles are those of the fixed frame, whatever the formulation.
    """

    kind: str
    pole: Complex
    degree: Array
    column: NDArray[np.intp]
    vector: Complex

    @property
    def frequency(self) -> Array:
        """|Im pole| / 2π [Hz], NaN where the mode is lost."""
        return np.abs(self.pole.imag) / (2.0 * math.pi)

    @property
    def whirl(self) -> Array:
        """+1 forward, −1 backward, 0 planar: which circular part of y, z dominates."""
        return np.where(np.abs(self.degree) < PLANAR, 0.0, np.sign(self.degree))

    @property
    def born(self) -> int:
        """First speed at which it is there."""
        return int((self.column >= 0).argmax())


def branches_of(scene: Scene, spec: CampbellSpec) -> list[Branch]:
    """All modes that come below ``spec.max_frequency``."""
    branches = _coupled(scene, spec)
    for motion, alone in (("bending", _bending), ("axial", _axial), ("torsion", _torsion)):
        if motion not in scene.coupled_motions:
            branches += alone(scene, spec)
    return [b for b in branches if np.nanmin(b.frequency) <= spec.max_frequency]


def home_of(scene: Scene, kind: str) -> str:
    """A motion whose system a mode of this kind was found in, the same for all coupled ones."""
    coupled = scene.coupled_motions
    return min(coupled) if kind in coupled else kind


def modes_of(scene: Scene, home: str, highest: float) -> Modes | ExactModes:
    """Modes of the system that ``home`` is part of, those of the exact shaft up to somewhat beyond
    ``highest`` [Hz]; poles are those of the frame of the formulation."""
    if home == "bending" and scene.bends_exactly:
        beyond = 2.0 * math.pi * MARGIN * highest
        exactly = partial(scene.exact.modes, scene.bending_modes, beyond)
        return scene.timed("exact bending modes", exactly)
    return scene.vibration(home)[1]


def _bending(scene: Scene, spec: CampbellSpec) -> list[Branch]:
    found = modes_of(scene, "bending", spec.max_frequency)
    frame = scene.bending.frame
    free = found.at_rest(frame)
    found = dataclasses.replace(found, pole=found.pole + 1j * frame[:, None])
    if not scene.bending.isotropic:
        branches = _followed("bending", found, free, spec, +1.0)
        return [replace(b, degree=whirl_degree(b.vector, b.column < 0)) for b in branches]
    return [
        replace(b, degree=np.where(b.column < 0, np.nan, side))
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
        degree = branch.degree
        if kind == "bending":
            degree = whirl_degree(branch.vector[:, places[kind]], branch.column < 0)
        branches.append(replace(branch, kind=kind, degree=degree))
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


def whirl_degree(vector: Complex, lost: NDArray[np.bool_]) -> Array:
    """Forward less backward share of motions (speeds, 2m) of both planes, NaN where ``lost``."""
    y, z = np.split(vector, 2, axis=1)
    forward, backward = np.abs(y + 1j * z), np.abs(y - 1j * z)
    difference = (forward**2 - backward**2).sum(axis=1)
    return np.where(lost, np.nan, difference / (forward**2 + backward**2).sum(axis=1))
