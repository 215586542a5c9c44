"""Every case of the project is read and run whole; its outcomes are looked at."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rotordyn
from docs.site.runs import case_run
from rotordyn.case.case import Case
from rotordyn.cli.screen import on_screen
from rotordyn.job.delivery import write
from rotordyn.job.results import Results
from rotordyn.report.datasets import dataset
from tests.few_speeds import at_few_speeds
from tests.hostile.numbers import unexplained
from tests.oracles.spindles import CASES

pytestmark = pytest.mark.usefixtures("draft")

FILES = sorted(CASES.glob("*.yaml"))
NAMES = [path.stem for path in FILES]


def test_cases_of_the_main_job_are_there() -> None:
    assert {"mfw2310", "mfw2310_computed", "vex70", "lalanne_ferraris"} <= set(NAMES)


def test_every_case_is_in_the_table_of_the_folder() -> None:
    table = (CASES / "README.md").read_text(encoding="utf-8")
    assert [name for name in NAMES if f"`{name}.yaml`" not in table] == []


FRICTION = ("only if friction is above",)  # at the lowest loads
SLIPS = ("the balls need more friction than the lubricant provides",)
# of a chart at few speeds, not of the case
FEWER = "too far apart for the lobes", "too far apart for the resonances"
WARNED = {  # what the case is there to show
    "preload_concepts": ("are mounted face to face (X)",),
    "grinding_spindle_life": SLIPS,
    "grinding_spindle_warm": ("the fits of their inner rings loosen",),
    "mfw2310_lobes": ("period doubling limits", "too far apart for the resonances"),
    "mfw2310_thin_wall": ("period doubling limits", "too far apart for the resonances"),
    "mfw2310_uneven_teeth": ("period doubling limits",),
    "deep_groove_uneven_teeth": (
        "period doubling limits",
        "repeats with the pattern of teeth limits",
    ),
    "mfw2310_axial_cycle": ("is unloaded under an axial force",),
    "mfw2310_films": ("oil films change its axial load",),
    "mfw2310_phases": FRICTION,
    "mfw2310_rigid_or_sprung": ("is unloaded under an axial force",),
    "friswell_internal_damping": (
        "viscous: bending 1 forward is unstable from",
        "hysteretic: bending 1 forward is unstable from",
        ": unstable at",
    ),
    "qj218": ("contact ellipse passes the shoulder of the inner ring, first under 70000 N",),
    "friswell_oil_films": ("unstable", "is unstable from"),
    "friswell_tapered_shaft": ("unstable", "is unstable from", "modes are overdamped"),
    "friswell_cross_coupled": ("frf: the machine is undamped",),
    "grinding_spindle_catalogue": ("estimate from catalogue values",),
    "grinding_spindle_knock": ("estimate from catalogue values",),
    "grinding_spindle_rings": (
        "bearing a: its ball 13, at 180°",
        "has clearance in its housing by its fit",
        "apart: rings of bearings a and b (5 mm of housing or sleeve), c and d",
    ),
    "grinding_spindle_touch": ("estimate from catalogue values",),
    "grinding_spindle_warm_up": ("rigid: bearing ", "spring: bearing "),
    "squeeze_film_damper": ("modes are overdamped",),
    "vex70": FRICTION,
    "vex70_hypotheses": FRICTION,
    "vex70_inertia": FRICTION,
    "vex70_steel_or_hybrid": FRICTION,
    "vex70_warm": ("there is no thermal balance above", "hotter than 150 °C"),
}


ENDED = {"vex70_warm": "temperatures run away"}  # where states end, as the case is there to show


SLOW = {  # whose analyses other cases have, too
    "deep_groove_uneven_teeth",
    "grinding_spindle_knock",
    "grinding_spindle_touch",
    "mfw2310_interval",
    "mfw2310_lobes",
    "mfw2310_phases",
    "mfw2310_rings",
    "mfw2310_uneven_teeth",
}
OFTEN = [
    pytest.param(path, marks=[pytest.mark.long] if path.stem in SLOW else [], id=path.stem)
    for path in FILES
]


@pytest.mark.parametrize("path", OFTEN)
def test_case_runs(path: Path, tmp_path: Path) -> None:
    """At few of its speeds, without figures."""
    case = rotordyn.load(path)
    assert case.name == path.stem
    assert case.title
    few, folder = at_few_speeds(case), tmp_path / case.name
    write(rotordyn.run(few, interval=few.uncertain is not None), folder, figures=False)
    assert not [*folder.glob("*.png")]
    _looked_at(few, folder)


@pytest.mark.long
@pytest.mark.parametrize("path", FILES, ids=NAMES)
def test_case_runs_whole(path: Path, runs: Path) -> None:
    """At all its speeds, with figures."""
    case = rotordyn.load(path)
    folder = case_run(case, runs)
    results = _looked_at(case, folder)
    figures = {p.stem for p in folder.glob("*.png")}
    assert figures
    assert set(results.figures) >= figures
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    assert set(results.figures) - figures <= set(record["skipped"]), "drawn, or said why not"
    meant = WARNED.get(case.name, ())
    assert all(any(words in w for w in record["warnings"]) for words in meant)


def _looked_at(case: Case, folder: Path) -> Results:
    """No warning but those meant, every speed solved, every number finite."""
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    answered = {f"{v}/{a}" for v in case.variants for a in case.analyses} or set(case.analyses)
    assert set(record["outcomes"]) == answered
    for name, words in record["outcomes"].items():
        odd = {word for word in words if word and ENDED.get(case.name, word + "!") not in word}
        assert not odd, name
    text = (folder / "summary.txt").read_text(encoding="utf-8")
    assert len(on_screen(text, folder / "summary.txt").splitlines()) <= 60
    meant = (*WARNED.get(case.name, ()), *FEWER)
    assert [w for w in record["warnings"] if not any(words in w for words in meant)] == []
    results = rotordyn.open(folder)
    assert set(results) == answered
    assert results.case == _stored(case)
    for name, part in results.parts.items():
        for analysis, result in part.results.items():
            held = results[f"{name}/{analysis}" if name else analysis]
            assert held.sizes["speed"] == len(case.speeds)
            assert list(unexplained(result)) == [], f"{name}/{analysis}"
            assert dataset(result).identical(held), f"{name}/{analysis} is rebuilt otherwise"
    return results


def _stored(case: Case) -> Case:
    """A case as folders keep it: files by folder and name alone."""
    files = tuple(Path(path.parent.name) / path.name for path in case.files)
    variants = {name: _stored(variant) for name, variant in case.variants.items()}
    return replace(case, files=files, variants=variants)


def test_computed_growth_and_shortening_differ_from_the_identified_ones() -> None:
    """Rings: what shaft, ring and fit give; seats d, e: near −29.4 µm instead of −42.8 µm."""
    loaded = [rotordyn.load(CASES / f"{n}.yaml") for n in ("mfw2310", "mfw2310_computed")]
    top = 24000 * math.pi / 30
    from rotordyn.preload.growth import ring_growth
    from rotordyn.preload.shortening import seat_shifts

    growth, shift = [], []
    for case in loaded:
        assert case.spindle is not None
        speed = np.array([0.0, top])
        growth.append(ring_growth(case.spindle, case.spindle.seats[0], speed) * 1e6)
        shift.append(seat_shifts(case.spindle, speed)[1] * 1e6)
    assert growth[0] == pytest.approx([43.2, 50.5])
    assert growth[1][0] == pytest.approx(43.2)
    assert 3.0 < growth[1][1] - growth[1][0] < 15.0
    assert shift[0] == pytest.approx([0, 0, -0.305, -42.8, -42.8])
    assert shift[1][3:].mean() == pytest.approx(-29.4, abs=0.05)
