"""One screen of plain text about variants: a table for every question, a line per variant."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from rotordyn.analyses.bearing.result import BearingMapResult
from rotordyn.analyses.bearing.solve import under
from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.control.result import ControlResult
from rotordyn.analyses.frf.result import FrequencyResponse
from rotordyn.analyses.frf.summary import speeds_compared
from rotordyn.analyses.known import matches
from rotordyn.analyses.preload.known import preload_sum
from rotordyn.analyses.preload.result import PreloadResult
from rotordyn.analyses.section_forces.result import SectionForcesResult
from rotordyn.analyses.section_forces.summary import extremes
from rotordyn.analyses.stiffness.result import StiffnessResult
from rotordyn.analyses.unbalance.result import UnbalanceResult
from rotordyn.analyses.unbalance.summary import largest_amplitudes
from rotordyn.machine.reference import Reference
from rotordyn.report.known import computed_values, known_values
from rotordyn.report.summary import Described, called
from rotordyn.results.display import RPM, STIFFNESS, number
from rotordyn.results.text import from_to, opening, wrapped

MODES = 5  # of the lowest bending modes
Cells = dict[str, str]
Variant = tuple[Described, Mapping[str, Any]]


def comparison_summary(
    case: Described,
    variants: Sequence[Variant],
    warnings: Sequence[str] = (),
    notes: Sequence[str] = (),
) -> str:
    """Key figures at the first and the last speed, then the known values that apply."""
    lines = opening(warnings, called(case), notes)
    for name, (title, cells) in TABLES.items():
        rows = [(own.title, cells(found[name], own)) for own, found in variants if name in found]
        if any(entries for _, entries in rows):
            lines += ["", f"{title}, {_ends(variants, name)}", *_aligned(rows)]
    known = _known(variants)
    return "\n".join([*lines, *([""] if known else []), *known])


def _ends(variants: Sequence[Variant], name: str) -> str:
    speed = next(found[name] for _, found in variants if name in found).speed
    return f"{from_to(speed * RPM.factor, 0)} rpm"


def _aligned(rows: Sequence[tuple[str, Cells]]) -> list[str]:
    """A head and a line per row; columns as wide as their widest entry."""
    heads = list(dict.fromkeys(head for _, cells in rows for head in cells))
    table = [["", *heads], *([name, *(c.get(h, "–") for h in heads)] for name, c in rows)]
    widths = [max(len(line[k]) for line in table) for k in range(len(heads) + 1)]
    return ["  ".join(map(str.ljust, line, widths)).rstrip() for line in table]


def _known(variants: Sequence[Variant]) -> list[str]:
    """Every known value once, and beside it what each variant it applies to gives."""
    beside: dict[Reference, list[tuple[str, str]]] = {}
    for case, found in variants:
        for each in matches(case.known, found, case.spindle):
            ours = computed_values(each)
            beside.setdefault(each.reference, []).append((case.title, ours))
    return [line for reference, ours in beside.items() for line in _beside(reference, ours)]


def _beside(reference: Reference, ours: Sequence[tuple[str, str]]) -> list[str]:
    head = f"{reference.kind}  {known_values(reference)}"
    if len(ours) > 1 and len({values for _, values in ours}) == 1:
        ours = [("all of them", ours[0][1])]
    lines = [head, *(f"    {title}: {values}" for title, values in ours)]
    return [part for line in lines for part in wrapped(line)]


def _campbell(result: CampbellResult, _: Described) -> Cells:
    """Of the lowest bending modes both whirls at rest and at top speed."""
    at = [_bending(result, row) for row in ((0, -1) if len(result.speed) > 1 else (0,))]
    return {
        f"bending {k + 1}": " → ".join(modes[k] if k < len(modes) else "–" for modes in at)
        for k in range(min(MODES, max(map(len, at))))
    }


def _bending(result: CampbellResult, row: int) -> list[str]:
    """Backward/forward frequencies of the bending modes at a speed, one number where equal."""
    chosen = [k for k in np.flatnonzero(~result.mostly_overdamped) if result.kind[k] == "bending"]
    values = result.frequency[row, chosen]
    known = np.flatnonzero(np.isfinite(result.whirl).any(axis=1))
    whirl = result.whirl[known[-1], chosen]  # at rest twins need not turn either way
    order = np.argsort(values, kind="stable")
    backward, forward = ([values[k] for k in order if whirl[k] == w] for w in (-1.0, 1.0))
    if abs(len(backward) - len(forward)) > 1 or len(backward) + len(forward) < len(order):
        return [number(values[k]) for k in order]
    return [
        number(b) if _alike(b, f) else f"{number(b)}/{number(f)}"
        for b, f in zip(backward, forward, strict=False)
    ]


def _alike(one: float, other: float) -> bool:
    """Equal as printed, or both without a value."""
    return math.isclose(one, other, rel_tol=1e-6) or not (math.isfinite(one + other))


def _frf(result: FrequencyResponse, _: Described) -> Cells:
    """The likeness of every measured response to the computed one, 1 at best."""
    return {
        f"{name} at {speeds_compared(result, row)}": (
            f"{result.likeness[row]:.3f}" if math.isfinite(result.likeness[row]) else "–"
        )
        for row, name in enumerate(result.measured)
    }


def _preload(result: PreloadResult, case: Described) -> Cells:
    if case.spindle is None:
        return {}
    total = preload_sum(result, case.spindle)
    stops = {
        f"stop {name} [rpm]": number(speed * RPM.factor, 0) if math.isfinite(speed) else "not met"
        for name, speed in zip(result.sleeve, result.stop_speed, strict=True)
    }
    return {"sum [N]": from_to(total, 0), **stops}


def _stiffness(result: StiffnessResult, _: Described) -> Cells:
    return {
        f"{name.replace('_', ' ')} [N/µm]": from_to(values)
        for name, values in zip(result.variant, result.tangent.T * STIFFNESS.factor, strict=True)
    }


def _bearing(result: BearingMapResult, _: Described) -> Cells:
    values = result.stiffness[:, :, 0] * STIFFNESS.factor
    return {
        under(result, k): ", ".join(from_to(values[:, k, i, i]) for i in (0, 1))
        for k in range(len(result.load))
    }


def _control(result: ControlResult, _: Described) -> Cells:
    inner, outer = (from_to(load, 0) for load in result.boundary_load)
    return {"inner from": inner, "outer up to": outer}


def _section_forces(result: SectionForcesResult, _: Described) -> Cells:
    return extremes(result)


def _unbalance(result: UnbalanceResult, _: Described) -> Cells:
    return largest_amplitudes(result)


TABLES: dict[str, tuple[str, Callable[[Any, Described], Cells]]] = {
    "campbell": ("bending modes, backward/forward [Hz]", _campbell),
    "preload": ("preload", _preload),
    "frf": ("likeness of measured responses, 1 at best", _frf),
    "stiffness": ("radial stiffness at no load", _stiffness),
    "section_forces": ("section forces of largest amount", _section_forces),
    "unbalance": ("largest half axis of the orbit by unbalance", _unbalance),
    "bearing": ("axial and radial stiffness, tilts blocked [N/µm]", _bearing),
    "control": ("axial load [N] at which race control changes", _control),
}
