"""The MFW 2310 identified again, compared with the thesis and with measurements; synthetic data."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

from docs.generate.marked import table
from docs.generate.pictures import keep_figure
from docs.generate.places import ROOT
from rotordyn.job import solve
from rotordyn.study.identification import Identification
from rotordyn.study.identification.read import read_identification
from rotordyn.study.identification.solve import identified

STUDY = ROOT / "cases" / "identification" / "mfw2310.yaml"
# D. Noël, doctoral thesis, 2013, table 3.7, and measured values.
THESIS = {
    "P1": "574",
    "P2": "528",
    "Kp1": "6.20",
    "Kp2": "5.49",
    "stop": "52.2",
    "Δu0": "43.2",
    "fo": "0.571",
    "friction": "80.9",
    "Δu24 − Δu0": "7.3",
    "shift c": "−0.305",
    "shift d e": "−42.8",
}
NOTES = {
    "P1": "sum 1200 N, including friction",
    "Kp1": "sum 12.0 N/µm beyond unloading",
    "friction": "half of the loop",
    "shift c": "−4.37 by 3D finite elements",
    "shift d e": "−32.8 by 3D finite elements",
}
MODES = ((4000, "1000–1150"), (24000, "910–920"))


@cache
def again() -> Identification:
    """The study solved."""
    return identified(read_identification(STUDY), workers=1)


def identified_table() -> str:
    """Values of the thesis, identified values with intervals, measured values."""
    best = again().explained
    rows = []
    for unknown, word in zip(best.problem.unknowns, best.sure.words, strict=True):
        k = best.problem.unknowns.index(unknown)
        value = unknown.shown(float(best.sure.values[k]))
        low, high = (unknown.shown(float(end)) for end in best.sure.interval[k])
        cell = f"{_plain(value)} ({_plain(low)} to {_plain(high)})"
        name = unknown.heading
        rows.append((name, THESIS[unknown.name], cell, word, NOTES.get(unknown.name, "")))
    return table(("", "thesis, phase 6:", "identified (95 %):", "", "measured or known"), rows)


def predicted_table() -> str:
    """Measured values and those of the identified machine."""
    found, rows = again(), []
    best = found.explained
    for measurement, residual in zip(best.problem.measurements, best.residuals, strict=True):
        data = measurement.data
        if len(residual) > 1:
            continue
        observed = float(data.observed[0]) * data.factor
        machine = observed - float(residual[0]) * data.factor
        noise = float(data.deviation[0]) * data.factor
        rows.append(
            (f"{data.name} [{data.unit}]", f"{_plain(observed)} ± {noise:g}", _plain(machine))
        )
    for each in found.predictions:
        measured = "" if each.measured is None else _plain(each.measured)
        ends = "–" if each.bound else f"{_plain(each.low)} to {_plain(each.high)}"
        value = f"{_plain(each.value)} ({ends})"
        rows.append((f"predicted: {each.name} [{each.unit}]", measured, value))
    frequency = solve(found.best).results["campbell"]
    for k, (rpm, measured) in enumerate(MODES):
        row = np.asarray(frequency.frequency[k])
        bending = [str(name).startswith("bending") for name in frequency.mode]
        values = sorted(row[np.array(bending) & np.isfinite(row)].tolist())[:4]
        words = ", ".join(f"{value:.0f}" for value in values)
        rows.append((f"lowest bending modes at {rpm} rpm [Hz]", f"{measured} (dominant)", words))
    return table(("", "measured:", "identified machine:"), rows)


def _plain(value: float) -> str:
    return f"{value:.4g}".replace("-", "−")


def draw_identified() -> None:
    """Figures of the study."""
    for name in ("measured", "correlation"):
        keep_figure(again().plot(name), f"mfw2310_identified_{name}")


def synthetic_table(found: dict[str, Any]) -> str:
    """Identification of random machines from synthetic data, as measured last."""
    names = ("P1", "P2", "Kp1", "Kp2", "stop", "friction", "Δu0", "Δu24", "fo")
    half = 100.0 * found["stiffness half interval"]
    mean, error = (100.0 * found[f"stiffness {word}"] for word in ("mean", "error of the mean"))
    covered = ", ".join(f"{n} {k}" for n, k in zip(names, found["covered"], strict=True))
    rows = [
        ("values within their 95 % interval", covered),
        (
            f"radial stiffness at 24 000 rpm within its 95 % interval (median ± {half:.1f} %)",
            str(found["stiffness covered"]),
        ),
        ("radial stiffness within 2 %", str(found["stiffness within 2 %"])),
        ("largest difference of the radial stiffness", f"{100.0 * found['stiffness off']:.1f} %"),
        (
            "mean difference and its standard error",
            f"{mean:.2f} ± {error:.2f} %".replace("-", "−"),
        ),
        ("true hypothesis is retained", str(found["true retained"])),
        ("a false one (kinematics or sharing) is retained too", str(found["false retained"])),
        (
            "seconds of one fit, median and longest",
            f"{found['seconds']:.1f}, {found['longest']:.0f}",
        ),
    ]
    return table((f"of {found['machines']} machines", ""), rows)
