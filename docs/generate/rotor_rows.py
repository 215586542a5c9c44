"""Accuracy of rotors."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

import rotordyn
from bearings import Material
from docs.generate.places import ROOT
from docs.generate.rows import Row
from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.equation.mesh import build_mesh
from rotordyn.job import solve
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from tests.oracles.dense_rotor.assemble import bending_plane
from tests.oracles.spinning_beam import PinnedBeam

Array = NDArray[np.float64]
BEAM, SPIN = PinnedBeam(0.5, 0.10), 2000.0


def rotor_rows() -> list[Row]:
    """The exact spinning beam with its rate of convergence, and a rotor of the literature."""
    coarse, fine = (_beam_error(elements) for elements in (64, 128))
    rate = tuple(float(r) for r in np.log2(coarse / fine))
    return [
        Row(
            "spinning Timoshenko beam, length 5 diameters, 2000 rad/s: order of convergence, "
            "first mode backward and forward",
            rate,
            0.03,
            "derived for the element ([theory](theory/shaft.md))",
            (2.0, 2.0),
        ),
        Row(
            "as above with 128 elements: errors of the two frequencies",
            tuple(float(e) for e in np.abs(fine)),
            5e-4,
            "closed form (Zu and Han, 1992)",
        ),
        *_lalanne_ferraris(),
    ]


def _beam_error(elements: int) -> Array:
    """Relative errors of the first backward and forward whirl (2,)."""
    spindle = Spindle(
        "beam",
        Shaft(0.0, (Section(BEAM.length, BEAM.diameter, 0.0, _material()),), BEAM.kappa),
    )
    plane = bending_plane(spindle, build_mesh(spindle, BEAM.length / elements))
    free = np.setdiff1d(np.arange(len(plane.mass)), [0, len(plane.mass) - 2])
    mass, polar, stiffness = (
        m[np.ix_(free, free)] for m in (plane.mass, plane.polar, plane.stiffness)
    )
    found = _whirl(mass, SPIN * polar, stiffness)
    exact = np.array(BEAM.bending_whirl(1, SPIN))
    first = np.array([-found[found < 0.0].max(), found[found > 0.0].min()])
    return np.asarray(first / exact - 1.0)


def _whirl(mass: Array, turning: Array, stiffness: Array) -> Array:
    """All ω of (K + ω Ω Jp − ω² M) φ = 0, from the symmetric pencil in 1/ω."""
    zero = np.zeros_like(mass)
    left = np.block([[turning, -mass], [-mass, zero]])
    right = np.block([[stiffness, zero], [zero, mass]])
    inverse = eigh(-left, right, eigvals_only=True)
    return np.asarray(1.0 / inverse)


def _material() -> Material:
    return Material("steel", BEAM.young_modulus, BEAM.poisson_ratio, BEAM.density)


def _lalanne_ferraris() -> list[Row]:
    case = rotordyn.load(ROOT / "cases" / "lalanne_ferraris.yaml")
    found = solve(case).results["campbell"]
    if not isinstance(found, CampbellResult):
        raise TypeError(type(found))
    bending = [kind == "bending" for kind in found.kind]
    rows = []
    for reference, when, allowed in zip(
        case.references, ("at rest", "at 30 000 rpm"), (1e-4, 3e-3), strict=True
    ):
        at = int(np.abs(found.speed - reference.speeds[0]).argmin())
        lowest = np.sort(found.frequency[at, bending])[: len(reference.values)]
        what = f"Lalanne–Ferraris rotor {when}, first four modes [Hz]"
        values = tuple(float(f) for f in lowest)
        rows.append(Row(what, values, allowed, reference.source, reference.values))
    return rows
