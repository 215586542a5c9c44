"""Axial behaviour of the MFW 2310: values printed in the thesis and computed by the cases."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

import rotordyn
from docs.generate.marked import table
from docs.generate.places import ROOT
from docs.generate.rows import number, numbers
from rotordyn.job import solve
from rotordyn.machine.history import HistoryStep, Past
from rotordyn.preload.friction import operating_state

Array = NDArray[np.float64]
RPM = math.pi / 30.0
HEAD = ("quantity", "figure", "thesis", "computed", "assumptions, reasons for differences")
PLAIN = "α 25°, fi 0.56, fo 0.54, 25 balls, no growth, no shift; springs of 602 N, 6 N/µm each"
NEVER = "the thesis does not print the parameters of its example"
SIGN = "the identified parameters belong to the other sign of the gyroscopic moment"
PHASES = (  # thesis: computed travel of the rear sleeve at 16 and 24 krpm, mean error [µm]
    ("3.2", "37.0", "76.7 (text of phase 1), 63.4 (text of phase 4)", "5.47"),
    ("3.3", "37.0", "63.2", "3.33"),
    ("3.4", "37.0", "76.7", "1.03"),
    ("3.5", "34.7", "80.2", "0.726"),
    ("3.6", "34.9", "80.3", "0.458"),
    ("3.7", "–", "–", "0.48"),
)


@cache
def solved(name: str) -> Mapping[str, Mapping[str, Any]]:
    """Results of a case by variant and analysis."""
    case = rotordyn.load(ROOT / "cases" / f"{name}.yaml")
    return {key: solve(variant).results for key, variant in case.variants.items()}


def stiffness(name: str, variant: str, rpm: float) -> Array:
    """Axial stiffness at no load, force falling and rising [N/µm]."""
    cycle = solved(name)[variant]["axial_cycle"]
    return np.asarray(cycle.no_load_stiffness[_row(cycle, rpm)] / 1e6)


def preload_sum(name: str, variant: str, rpm: float) -> float:
    """Load of both front bearings [N]."""
    state = solved(name)[variant]["preload"]
    return float(state.axial_load[_row(state, rpm), :2].sum())


def axial_table() -> str:
    """Values of chapter III of the thesis and computed ones."""
    rows = [*_concepts(), *_identified()]
    return table(HEAD, rows)


def phase_table() -> str:
    """The six sets of parameters: travel of the rear sleeve and axial stiffness with each."""
    name, rows = "mfw2310_phases", []
    for k, (variant, (where, slow, fast, error)) in enumerate(
        zip(solved(name), PHASES, strict=True), start=1
    ):
        state = solved(name)[variant]["preload"]
        rear = [-1e6 * state.position[_row(state, rpm), 2] for rpm in (16000.0, 24000.0)]
        falling, rising = stiffness(name, variant, 4000.0)
        reached = float(state.stop_speed[0] / RPM)
        rows.append(
            (
                f"{k} (table {where})",
                slow,
                f"{rear[0]:.1f}",
                fast,
                f"{rear[1]:.1f}",
                error,
                f"{falling:.0f}, {rising:.0f}",
                f"{reached:.0f}" if math.isfinite(reached) else "not reached",
            )
        )
    head = (
        "phase",
        "rear sleeve, 16 krpm [µm], thesis:",
        "computed:",
        "24 krpm, thesis:",
        "computed:",
        "mean error in the thesis, all points [µm]:",
        "computed at 4 krpm, no load: stiffness falling, rising [N/µm]:",
        "front stop reached [rpm]:",
    )
    return table(head, rows)


def concepts() -> dict[str, tuple[Array, Array]]:
    """Stiffness at no load and sum of preloads at 0, 16 and 24 krpm, rigid and sprung."""
    name, speeds = "mfw2310_rigid_or_sprung", (0.0, 16000.0, 24000.0)
    return {
        variant: (
            np.array([stiffness(name, variant, rpm)[0] for rpm in speeds]),
            np.array([preload_sum(name, variant, rpm) for rpm in speeds]),
        )
        for variant in ("rigid", "sprung")
    }


def _concepts() -> list[tuple[str, ...]]:
    known = {
        "rigid": ("3.4", "3.3", (650.0, 441.0, 434.0), (1200.0, 3160.0)),
        "sprung": ("3.5", "3.5", (331.0, 94.3, 68.5), (1205.0, 1650.0)),
    }
    found, rows = concepts(), []
    for variant, (figure, other, published, sums) in known.items():
        computed, loads = found[variant]
        remark = [PLAIN + "; " + NEVER, ""] if variant == "rigid" else ["", ""]
        what = f"{variant} preload, axial stiffness at 0, 16, 24 krpm"
        falls = [f"{_fall(each, 1):.1f}, {_fall(each, 2):.1f}" for each in (published, computed)]
        rows += [
            (f"{what} [N/µm]", figure, numbers(published), numbers(tuple(computed)), remark[0]),
            ("decrease from rest [%]", figure, *falls, ""),
            (
                f"{variant} preload, sum of preloads at 0, 24 krpm [N]",
                other,
                numbers(sums),
                numbers((float(loads[0]), float(loads[2]))),
                "",
            ),
        ]
    share = found["sprung"][0][0] / found["rigid"][0][0]
    rows.append(
        ("ratio of sprung to rigid stiffness at rest", "3.4, 3.5", "0.509", number(share), "")
    )
    return rows


def _identified() -> list[tuple[str, ...]]:
    name, phases = "mfw2310_axial_cycle", "mfw2310_phases"
    still = solved(name)["rubbing"]["axial_cycle"]
    state = solved(phases)["phase_6"]["preload"]
    rear = [-1e6 * state.position[_row(state, rpm), 2] for rpm in (16000.0, 24000.0)]
    shaft = -1e6 * float(state.position[_row(state, 24000.0), 0])
    slow, fast = (stiffness(phases, "phase_6", rpm) for rpm in (4000.0, 24000.0))
    lowest = [
        min(float(each[branch]) for each in still.no_load_stiffness) / 1e6 for branch in (0, 1)
    ]
    sums = tuple(preload_sum(phases, "phase_6", rpm) for rpm in (0.0, 24000.0))
    mean, held = _held(still, -815.0), _slopes(-815.0)
    return [
        (
            "rear sleeve at 16, 24 krpm, measured [µm]",
            "3.8",
            "37.0, 80.2",
            numbers(tuple(rear)),
            f"phase 6; {SIGN}",
        ),
        ("shaft at 24 krpm, no load [µm]", "3.26", "about 25", f"{shaft:.1f}", ""),
        ("sum of preloads at 0, 24 krpm [N]", "3.26", "1100, 1600", numbers(sums), SIGN),
        (
            "slope with the front bearings unloaded, 0 krpm [N/µm]",
            "3.9",
            "about 12.0",
            f"{_past():.2f}",
            f"springs of {_springs():.2f} N/µm in series with bearings; the thesis takes "
            "the springs alone, the limit of rigid bearings",
        ),
        (
            "stiffness at no load, 4 krpm, force falling, rising [N/µm]",
            "3.23",
            "153, 139 (measured)",
            f"{slow[0]:.0f}, {slow[1]:.0f}",
            "phase 6",
        ),
        (
            "largest decrease over speed, relative to 4 krpm [%]",
            "3.23",
            "about 60",
            ", ".join(
                f"{100.0 * (1.0 - low / at):.0f}" for low, at in zip(lowest, slow, strict=True)
            ),
            "",
        ),
        (
            "stiffness at no load, 24 krpm, falling, rising [N/µm]",
            "3.23",
            "rises again, rising branch stiffer",
            f"{fast[0]:.0f}, {fast[1]:.0f}",
            "here the stop is closed on both branches, in the thesis on one",
        ),
        (
            "stiffness about −815 N, sleeve held, sliding [N/µm]",
            "3.28",
            "180, 120 (without friction)",
            f"{held[0]:.0f}, {held[1]:.0f}",
            "",
        ),
        ("cyclic force carried by friction about −815 N [N]", "3.29", "± 185", f"± {mean:.0f}", ""),
    ]


def _fall(values: Any, k: int) -> float:
    return 100.0 * (1.0 - float(values[k]) / float(values[0]))


def _row(result: Any, rpm: float) -> int:
    return int(np.abs(result.speed - rpm * RPM).argmin())


def _held(cycle: Any, force: float) -> float:
    known = np.isfinite(cycle.held_force[0])
    mean, held = cycle.held_mean[0, known], cycle.held_force[0, known]
    order = np.argsort(mean)
    return float(np.interp(force, mean[order], held[order]))


def _slopes(force: float) -> tuple[float, float]:
    """With the sleeve held, and without friction, on the branch of falling force [N/µm]."""
    case = rotordyn.load(ROOT / "cases" / "mfw2310_axial_cycle.yaml")
    found = []
    for spindle in (case.variants[name].spindle for name in ("rubbing", "smooth")):
        past = Past((HistoryStep(axial_force=1600.0),))
        state = operating_state(spindle, np.zeros(1), case.conditions.law, force, past=past)
        each = state.seat_stiffness()[0, :, 0, 0]
        front, rear = (sleeve.spring.stiffness for sleeve in spindle.sleeves)
        held = each[2] if spindle.sleeves[0].friction else _series(each[2], front)
        found.append(each[0] + each[1] + held + _series(each[3] + each[4], rear))
    return found[0] / 1e6, found[1] / 1e6


def _series(one: float, other: float) -> float:
    return 1.0 / (1.0 / one + 1.0 / other)


def _springs() -> float:
    """Stiffness of both springs [N/µm]."""
    spindle = rotordyn.load(ROOT / "cases" / "mfw2310_axial_cycle.yaml").variants["smooth"].spindle
    return sum(sleeve.spring.stiffness for sleeve in spindle.sleeves) / 1e6


def _past() -> float:
    """Slope with unloaded front bearings and an open stop [N/µm]."""
    smooth = solved("mfw2310_axial_cycle")["smooth"]["axial_cycle"]
    free = (smooth.axial_load[0, 0, :, 0] == 0.0) & (smooth.stop_force[0, 0, :, 0] == 0.0)
    return float(smooth.stiffness[0, 0, free].mean() / 1e6)
