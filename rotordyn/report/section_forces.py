"""Section forces in a few lines of text: extremes and where they are, reactions, twist."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from rotordyn.analysis.display import MEGAPASCAL, MICROMETRE, RPM
from rotordyn.analysis.results import SectionForcesResult
from rotordyn.report.text import from_to, unbroken

FORCES = {
    "N": "normal_force",
    "Ty": "shear_force_y",
    "Tz": "shear_force_z",
}
MOMENTS = {"Mt": "torque", "My": "bending_moment_y", "Mz": "bending_moment_z"}
LEAST = 1e-9  # of the largest force or moment: below that it is not there


def section_force_lines(result: SectionForcesResult) -> list[str]:
    """At the last speed with a solution, which is named where there are several."""
    row = int(np.flatnonzero(np.isfinite(result.torque).all(axis=1))[-1])
    at = f" at {result.speed[row] * RPM.factor:.0f} rpm" if len(result.speed) > 1 else ""
    bent = np.hypot(result.deflection_y[row], result.deflection_z[row]) * MICROMETRE.factor
    stress = result.von_mises_stress[row] * MEGAPASCAL.factor
    return [
        f"sections   largest{at} [N] {_extremes(result, row, FORCES)}",
        f"           [N m] {_extremes(result, row, MOMENTS)}",
        f"           deflection {_largest(result, bent, 2)} µm, von Mises stress at the outer fibre "
        f"{_largest(result, stress, 1)} MPa",
        f"reactions  [N, N m] {'; '.join(_reactions(result, row))}",
        *_twists(result),
    ]


def extremes(result: SectionForcesResult) -> dict[str, str]:
    """Largest amounts of each section force at the last speed with a solution."""
    row = int(np.flatnonzero(np.isfinite(result.torque).all(axis=1))[-1])
    return {
        f"{name} [{unit}]": f"{_amount(getattr(result, field)[row]):.4g}"
        for unit, fields in (("N", FORCES), ("N m", MOMENTS))
        for name, field in fields.items()
    }


def _extremes(result: SectionForcesResult, row: int, fields: dict[str, str]) -> str:
    scale = max(float(np.abs(getattr(result, field)[row]).max()) for field in fields.values())
    entries = []
    for name, field in fields.items():
        values = getattr(result, field)[row]
        if np.abs(values).max() <= LEAST * scale:
            entries.append(f"{name} 0")
            continue
        where = int(np.abs(values).argmax())
        entries.append(f"{name} {values[where]:.5g} at {result.cut[where] * 1e3:.1f} mm")
    return ", ".join(map(unbroken, entries))


def _amount(values: Any) -> float:
    """The value of largest amount, with its sign."""
    return float(values[np.abs(values).argmax()])


def _largest(result: SectionForcesResult, values: Any, digits: int) -> str:
    where = int(values.argmax())
    return unbroken(f"{values[where]:.{digits}f} at {result.cut[where] * 1e3:.1f} mm")


def _reactions(result: SectionForcesResult, row: int) -> Iterator[str]:
    """Loads on the shaft that are there, by support."""
    own = result.reaction[row]
    scale = np.array([np.abs(own[:, :3]).max(initial=0.0)] * 3 + [np.abs(own[:, 3:]).max()] * 3)
    for name, loads in zip(result.support, own, strict=True):
        parts = [
            f"{component} {load:.5g}"
            for component, load, most in zip(result.component, loads, scale, strict=True)
            if abs(load) > LEAST * most
        ]
        yield unbroken(f"{name} {' '.join(parts) or '0'}")


def _twists(result: SectionForcesResult) -> Iterator[str]:
    for k, name in enumerate(result.twist_limit):
        angle = np.degrees(np.abs(result.twist_between[:, k]))
        allowed = float(np.degrees(result.allowed_twist[k]))
        kept = "kept" if np.nanmax(angle) <= allowed else "EXCEEDED"
        bore = f" around a bore of {result.bore[k] * 1e3:g} mm" if result.bore[k] else ""
        yield (
            f"twist      {name}: {from_to(angle, 4)}° of {allowed:.4g}° allowed: {kept}; a uniform "
            f"shaft{bore} needs an outer diameter of "
            f"{from_to(result.required_diameter[:, k] * 1e3, 2)} mm"
        )
