"""Section forces in a few lines of text: extremes and where they are, reactions, twist."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from rotordyn.analyses.section_forces.result import SectionForcesResult
from rotordyn.results.described import Described
from rotordyn.results.display import MEGAPASCAL, MICROMETRE, RPM
from rotordyn.results.headline import Number, each_speed
from rotordyn.results.text import from_to, unbroken
from rotordyn.scene.linearity import not_small, tangent_warnings

FORCES = {
    "N": "normal_force",
    "Ty": "shear_force_y",
    "Tz": "shear_force_z",
}
MOMENTS = {"Mt": "torque", "My": "bending_moment_y", "Mz": "bending_moment_z"}
LEAST = 1e-9  # of the largest force or moment: a smaller one is rounding


def summary(result: SectionForcesResult) -> list[str]:
    """Extremes, reactions and twist at the last speed with a solution, named if there are more."""
    row = int(np.flatnonzero(np.isfinite(result.torque).all(axis=1))[-1])
    at = f" at {result.speed[row] * RPM.factor:.0f} rpm" if len(result.speed) > 1 else ""
    bent = np.hypot(result.deflection_y[row], result.deflection_z[row]) * MICROMETRE.factor
    stress = result.von_mises_stress[row] * MEGAPASCAL.factor
    return [
        f"sections   largest{at} [N] {_extremes(result, row, FORCES)}",
        f"           [N m] {_extremes(result, row, MOMENTS)}",
        f"           deflection {_largest(result, bent, 'µm')}, von Mises stress "
        f"{_largest(result, stress, 'MPa')}",
        f"reactions  [N, N m] {'; '.join(_reactions(result, row))}",
        *_twists(result),
    ]


def numbers(result: SectionForcesResult, _: Described) -> Iterator[Number]:
    """Largest amounts of each section force at the first and the last speed."""
    rows = np.flatnonzero(np.isfinite(result.torque).all(axis=1))
    for unit, fields in (("N", FORCES), ("N m", MOMENTS)):
        for name, field in fields.items():
            peaks = np.full(len(result.speed), np.nan)
            peaks[rows] = [_peak(result, int(row), field)[0] for row in rows]
            yield from each_speed(result, name, unit, peaks)


def _extremes(result: SectionForcesResult, row: int, fields: dict[str, str]) -> str:
    entries = []
    for name, field in fields.items():
        value, x = _peak(result, row, field)
        entries.append(f"{name} {value:.5g} at {x * 1e3:.1f} mm" if value else f"{name} 0")
    return ", ".join(map(unbroken, entries))


def _peak(result: SectionForcesResult, row: int, field: str) -> tuple[float, float]:
    """The value of largest amount, with its sign, and where it is [m]; 0 for rounding."""
    values = getattr(result, field)[row]
    where = int(np.abs(values).argmax())
    loaded = abs(values[where]) > _least(result, row) * _lever(result, field in MOMENTS.values())
    return float(values[where]) if loaded else 0.0, float(result.cut[where])


def _least(result: SectionForcesResult, row: int) -> float:
    """Force below which there is nothing but rounding [N]."""
    forces = max(np.abs(getattr(result, field)[row]).max() for field in FORCES.values())
    moments = max(np.abs(getattr(result, field)[row]).max() for field in MOMENTS.values())
    return LEAST * float(max(forces, moments / _lever(result, True)))


def _lever(result: SectionForcesResult, moment: bool) -> float:
    """The length of the shaft for a moment, 1 for a force."""
    return float(result.cut[-1] - result.cut[0]) if moment else 1.0


def _largest(result: SectionForcesResult, values: Any, unit: str) -> str:
    where = int(values.argmax())
    return unbroken(f"{values[where]:.4g} {unit} at {result.cut[where] * 1e3:.1f} mm")


def _reactions(result: SectionForcesResult, row: int) -> Iterator[str]:
    """Loads on the shaft by support; components of no more than rounding are omitted."""
    for name, loads in zip(result.support, result.reaction[row], strict=True):
        parts = [
            f"{component} {load:.5g}"
            for component, load in zip(result.component, loads, strict=True)
            if abs(load) > _least(result, row) * _lever(result, component.startswith("M"))
        ]
        yield unbroken(f"{name} {' '.join(parts) or '0'}")


def _twists(result: SectionForcesResult) -> Iterator[str]:
    for k, name in enumerate(result.twist_limit):
        angle = np.degrees(np.abs(result.twist_between[:, k]))
        allowed = float(np.degrees(result.allowed_twist[k]))
        verdict = "kept" if np.nanmax(angle) <= allowed else "exceeded"
        bore = f" around a bore of {result.bore[k] * 1e3:g} mm" if result.bore[k] else ""
        yield (
            f"twist      {name}: {from_to(angle, 4)}° of {allowed:.4g}° allowed, {verdict}; "
            f"uniform outer diameter at the limit{bore}: "
            + unbroken(f"{from_to(result.required_diameter[:, k] * 1e3, 2)} mm")
        )


def warnings(result: SectionForcesResult) -> list[str]:
    """Twist above what is allowed, loads beyond the tangents of bearings, large deflections."""
    largest = np.nanmax(np.abs(result.twist_between), axis=0)
    limits = zip(result.twist_limit, largest, result.allowed_twist, strict=True)
    sentences = [
        *tangent_warnings("section_forces", result.support, result.speed, result.departure)
    ]
    inclined = np.hypot(result.slope_y, result.slope_z)
    sentences += not_small("section_forces", result.speed, inclined)
    return sentences + [
        f"twist {name}: {np.degrees(angle):.4g} deg is above the {np.degrees(allowed):.4g} deg "
        "allowed"
        for name, angle, allowed in limits
        if angle > allowed
    ]
