"""Estimates from catalogue values: against the full solver, known insides, published rows."""

from __future__ import annotations

import csv
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize

from bearings import (
    SILICON_NITRIDE,
    STEEL,
    AngularContactBallBearing,
    Catalogue,
    EstimatedBearing,
    InvalidBearing,
    estimate,
    life,
)
from bearings.catalogue import estimate as estimating
from bearings.catalogue.estimate import _range
from bearings.catalogue.plausible import TIGHTEST, usual
from bearings.catalogue.races import contact_stiffness, interpolated, static_rating
from bearings.contact.hertz import curvature_difference, dimensionless
from bearings.geometry import geometry
from bearings.life.rating import Insides, rating

ROOT = Path(__file__).resolve().parents[2]
RINGS: dict[str, Any] = dict(bore=0.07, outside_diameter=0.11, width=0.02)
# GMN, catalogue 4000 0813 EN, KH 6014 E: 24 steel balls of 9.525 mm, pairs, rigidity in N/m
KH_6014_E: dict[str, Any] = RINGS | dict(
    contact_angle=math.radians(25.0),
    hybrid=False,
    preloads=[190.0, 570.0, 1150.0],
    rigidities=[143e6, 211e6, 274e6],
    dynamic_rating=22700.0,
    static_rating=16400.0,
)


def known(balls: int, diameter: float, angle: float, hybrid: bool, fi: float, fo: float) -> Any:
    return AngularContactBallBearing(
        ball_diameter=diameter,
        balls=balls,
        pitch_diameter=0.09,
        contact_angle=math.radians(angle),
        inner_conformity=fi,
        outer_conformity=fo,
        ball_material=SILICON_NITRIDE if hybrid else STEEL,
    )


KNOWN = [
    known(24, 9.525e-3, 25.0, False, 0.56, 0.52),
    known(21, 11.906e-3, 15.0, False, 0.535, 0.525),
    known(26, 8.731e-3, 15.0, True, 0.52, 0.53),
    known(22, 10.319e-3, 25.0, True, 0.55, 0.54),
]


def solved(bearing: Any, preload: float) -> tuple[float, float]:
    """Rigidity and unloading force of a pair, by the solver of the package."""
    state = bearing.equilibrium(load=[preload, 0.0, 0.0, 0.0, 0.0])
    twice = bearing.equilibrium(displacement=[2.0 * state.displacement[0], 0.0, 0.0, 0.0, 0.0])
    return 2.0 * float(state.complete_stiffness[0, 0]), float(twice.load[0])


def insides(bearing: Any) -> Insides:
    return Insides(
        *(
            np.array([float(getattr(bearing, name))])
            for name in (
                "ball_diameter",
                "balls",
                "pitch_diameter",
                "inner_conformity",
                "outer_conformity",
            )
        ),
        contact_angle=bearing.contact_angle,
    )


@pytest.mark.parametrize("bearing", KNOWN)
def test_contacts_are_those_of_the_solver(bearing: Any) -> None:
    races = geometry(bearing.grooves)
    both = (races.inner.stiffness ** (-2 / 3) + races.outer.stiffness ** (-2 / 3)) ** -1.5
    found = contact_stiffness(insides(bearing), bearing.ball_material, STEEL)
    assert found[0] == pytest.approx(both, rel=1e-6)


@pytest.mark.parametrize("bearing", KNOWN)
def test_catalogue_rows_of_known_bearings_give_them_back(bearing: Any) -> None:
    """Fitted on the medium class, judged on the others; the inside lies within its spread."""
    rows = {preload: solved(bearing, preload) for preload in (100.0, 300.0, 600.0)}
    found = estimate(
        **RINGS,
        contact_angle=bearing.contact_angle,
        hybrid=bearing.ball_material is SILICON_NITRIDE,
        preloads=[300.0],
        rigidities=[rows[300.0][0]],
        unloading=[rows[300.0][1]],
        static_rating=float(static_rating(insides(bearing), bearing.ball_material, STEEL)[0]),
    )
    for preload, (rigidity, unloading) in rows.items():
        assert found.pair(preload) == pytest.approx((rigidity, unloading), rel=0.02)
        assert solved(found, preload) == pytest.approx(found.pair(preload), rel=1e-5)
    with pytest.raises(InvalidBearing, match="preload of a pair must be positive"):
        found.pair(0.0)
    for name, (low, high) in found.spread.items():
        assert low - 0.006 <= getattr(bearing, name) <= high + 0.006, name


@pytest.mark.parametrize("bearing", KNOWN)
def test_grooves_follow_where_balls_are_printed(bearing: Any) -> None:
    x = insides(bearing)
    found = estimate(
        **RINGS,
        contact_angle=bearing.contact_angle,
        hybrid=bearing.ball_material is SILICON_NITRIDE,
        ball_diameter=bearing.ball_diameter,
        balls=bearing.balls,
        preloads=[100.0, 600.0],
        rigidities=[solved(bearing, p)[0] for p in (100.0, 600.0)],
        dynamic_rating=float(rating(x)[0]),
        static_rating=float(static_rating(x, bearing.ball_material, STEEL)[0]),
    )
    assert found.balls == bearing.balls
    assert found.ball_diameter == bearing.ball_diameter
    assert found.inner_conformity == pytest.approx(bearing.inner_conformity, abs=0.008)
    assert found.outer_conformity == pytest.approx(bearing.outer_conformity, abs=0.012)


@pytest.mark.parametrize("bearing", KNOWN)
def test_ratings_are_those_of_one_bearing(bearing: Any) -> None:
    x = insides(bearing)
    assert rating(x)[0] == pytest.approx(life.dynamic_rating(bearing), rel=1e-12)
    found = static_rating(x, bearing.ball_material, STEEL)[0]
    assert found == pytest.approx(life.static_rating(bearing), rel=1e-5)


@pytest.mark.parametrize("degrees", [45.0, 50.0, 60.0])
@pytest.mark.parametrize("given", [("dynamic",), ("static",), ("dynamic", "static")])
def test_steep_bearings_given_their_own_ratings_come_back(
    degrees: float, given: tuple[str, ...]
) -> None:
    """Above 45° ratings are of axial load; a ball screw bearing of 30 x 62 mm."""
    bearing = AngularContactBallBearing(
        ball_diameter=7.9375e-3,
        balls=17,
        pitch_diameter=0.046,
        contact_angle=math.radians(degrees),
        inner_conformity=0.53,
        outer_conformity=0.53,
        ball_material=STEEL,
    )
    x = insides(bearing)
    ratings = {"dynamic": life.dynamic_rating(bearing), "static": life.static_rating(bearing)}
    assert rating(x)[0] == pytest.approx(ratings["dynamic"], rel=1e-12)
    assert static_rating(x, STEEL, STEEL)[0] == pytest.approx(ratings["static"], rel=1e-5)
    found = estimate(
        bore=0.03,
        outside_diameter=0.062,
        contact_angle=bearing.contact_angle,
        hybrid=False,
        ball_diameter=bearing.ball_diameter,
        balls=bearing.balls,
        **{f"{name}_rating": ratings[name] for name in given},
    )
    assert life.dynamic_rating(found) == pytest.approx(ratings["dynamic"], rel=0.02)
    assert life.static_rating(found) == pytest.approx(ratings["static"], rel=0.05)
    assert found.inner_conformity == pytest.approx(0.53, abs=0.003)
    assert found.doubt == ""


def test_ratings_of_published_rows() -> None:
    """GMN S 6014 C and KH 6014 E; ISO's table of fc holds for fi = fo = 0.52."""
    s = known(21, 11.906e-3, 15.0, False, 0.52, 0.52)
    assert rating(insides(s))[0] == pytest.approx(48500.0, rel=0.006)
    s = known(21, 11.906e-3, 15.0, False, 0.52, 0.53)
    assert static_rating(insides(s), STEEL, STEEL)[0] == pytest.approx(46000.0, rel=0.03)
    hybrid = static_rating(insides(s), SILICON_NITRIDE, STEEL) / static_rating(
        insides(s), STEEL, STEEL
    )
    assert hybrid[0] == pytest.approx(0.70, rel=0.01)
    assert rating(insides(KNOWN[0]))[0] == pytest.approx(22700.0, rel=0.006)
    assert static_rating(insides(KNOWN[0]), STEEL, STEEL)[0] == pytest.approx(16400.0, rel=0.03)


def test_published_row_is_explained() -> None:
    found = estimate(**KH_6014_E)
    assert all(abs(each.deviation) < 0.02 for each in found.explained)
    assert found.spread["balls"][0] <= 24 <= found.spread["balls"][1]
    assert found.ball_diameter == pytest.approx(9.525e-3, abs=1e-6)
    assert isinstance(found, EstimatedBearing)
    assert "balls" in found.estimated
    assert "fi" in found.estimated


def test_members_spread_as_the_estimate() -> None:
    found = estimate(**KH_6014_E)
    members = found.members(40)
    counts = [member.balls for member in members]
    low, high = found.spread["balls"]
    assert min(counts) <= low + 1
    assert max(counts) >= high - 1
    rigidity = [solved(member, 570.0)[0] for member in members[::8]]
    assert np.allclose(rigidity, 211e6, rtol=0.06)


def test_given_ball_data_is_kept() -> None:
    found = estimate(**KH_6014_E, balls=24, inner_conformity=0.56)
    assert (found.balls, found.inner_conformity) == (24, 0.56)
    assert "balls" not in found.estimated
    assert "fi" not in found.estimated


def test_an_unloading_force_is_beyond_twice_the_preload() -> None:
    """A stiff pair unloads at 2.83 times its preload by δ ∝ F^(2/3), at 2 if it were linear."""
    given = dict(KH_6014_E, preloads=[570.0], rigidities=[211e6])
    with pytest.raises(
        InvalidBearing, match="force of 1139 N at a preload of 570 N: that of a pair"
    ):
        estimate(**given, unloading=[1139.0])
    with pytest.raises(InvalidBearing) as refused:  # contradicts the rest, not itself
        estimate(**given, unloading=[1150.0])
    assert "about three times" not in str(refused.value)


def test_what_c_is_taken_for_is_said_and_how_wrong_a_life_would_be() -> None:
    """C of a pair given for one cannot be determined from most data; L10 goes with C³."""
    found = estimate(**KH_6014_E)
    assert found.catalogue.dynamic_rating is not None
    times = (2.0**0.7) ** 3
    words = f"C as that of one bearing (of a pair: lives are {times:.1f} times too long)"
    assert words in found.estimated
    silent = estimate(**{**KH_6014_E, "dynamic_rating": None})
    assert "pair" not in silent.estimated


CONTRADICTIONS = [
    (
        dict(rigidities=[71.5e6, 105.5e6, 137e6]),
        r"looks like that of one bearing: give that of the pair.*agrees: dynamic rating C.*static",
    ),
    (dict(static_rating=70000.0), r"static rating C0 7e\+04 N.*agrees: rigidity at 190 N.*dynamic"),
    (dict(rigidities=[143e6, 211e6, 600e6]), r"rigidity at 1150 N 600 N/µm \(27.*agrees: rigidity"),
    (dict(unloading=[190.0, 570.0, 1150.0]), "about three times the preload"),
    (dict(rigidities=[143e6]), "one value for each of preloads: given 1 for 3"),
    (dict(rigidities=[143.0, 211.0, 274.0]), "in N/m, got 143: is the unit right"),
    (dict(rigidities=[9.9e4, 211e6, 274e6]), "in N/m, got 99000: is the unit right"),
    (dict(outside_diameter=0.072), "outside_diameter 72 mm must be well above bore 70 mm"),
    (dict(ball_diameter=0.03), "ball_diameter 30 mm does not fit a section of 20 mm"),
    (dict(pitch_diameter=0.12), "pitch_diameter 120 mm must lie between bore and outside_diameter"),
    (dict(pitch_diameter=0.071), "no ring left beside balls of .* on a pitch circle of 71 mm"),
    (dict(ball_diameter=0.0199, balls=12), "no ring left .* 19.9 mm .* a bore below 67.98 mm"),
    (dict(contact_angle=25.0), "contact_angle must lie"),
    (dict(contact_angle=math.radians(4.9)), "at least 5°, got 4.9"),
    (dict(preloads=[190.0, -5.0, 3.0]), "positive numbers"),
]


@pytest.mark.parametrize(("changed", "sentence"), CONTRADICTIONS)
def test_values_that_cannot_be(changed: dict[str, Any], sentence: str) -> None:
    with pytest.raises(InvalidBearing, match=sentence):
        estimate(**{**KH_6014_E, **changed})


def test_rigidities_from_a_tenth_of_a_newton_per_micrometre_on_are_values() -> None:
    printed = Catalogue(
        bore=0.07, outside_diameter=0.11, contact_angle=0.4, preloads=(190.0,), rigidities=(1e5,)
    )
    assert printed.values[0].words == "rigidity at 190 N 0.1 N/µm"


@pytest.mark.parametrize("given", [{}, {"rigidities": [], "preloads": []}])
def test_rating_of_a_pair_given_for_one_is_doubted(given: dict[str, Any]) -> None:
    """Balls are free to grow until they explain it: the other values show what is odd."""
    values = {**KH_6014_E, **given}
    assert estimate(**values).doubt == ""
    of_pair = estimate(**{**values, "dynamic_rating": 2**0.7 * 22_700 * 0.98})
    assert "a pair has 1.62 times as much; give that of one bearing" in of_pair.doubt
    assert estimate(**RINGS, contact_angle=0.4, dynamic_rating=40e3).doubt == ""


def test_preloads_twice_as_high_are_doubted() -> None:
    """The sum over both bearings of a pair: fewer, larger balls explain its rigidity, no others."""
    one = {**KH_6014_E, "dynamic_rating": None}
    assert estimate(**one).doubt == ""
    both = estimate(**one | {"preloads": [2.0 * each for each in one["preloads"]]})
    fill = both.balls * both.ball_diameter / (math.pi * both.pitch_diameter)
    assert f"balls fill {fill:.0%} of the pitch circle" in both.doubt
    given = {"balls": both.balls, "ball_diameter": both.ball_diameter}
    known = estimate(**one | given)
    assert "of the pitch circle" not in known.doubt


def test_a_contact_angle_just_above_the_least() -> None:
    assert estimate(**RINGS, contact_angle=math.radians(5.1), dynamic_rating=40e3).doubt == ""


def test_balls_on_a_pitch_circle_out_of_the_middle_leave_both_rings_a_wall() -> None:
    """Without rings in the way the likeliest ball would be 0.265 times the section, 10.6 mm."""
    found = estimate(**RINGS, contact_angle=0.4, pitch_diameter=0.0815)
    assert 0.5 * (found.pitch_diameter - 0.07) > found.ball_diameter * (0.5 * math.cos(0.4) + 0.1)
    assert estimate(**RINGS, contact_angle=0.4).ball_diameter > found.ball_diameter


@pytest.mark.parametrize(("estimate", "spread"), [(0.5, (0.5, 3.0)), (4.0, (1.0, 4.0))])
def test_an_estimate_beside_the_grid_is_an_end_of_its_spread(
    estimate: float, spread: tuple[float, float]
) -> None:
    assert _range(np.array([3.0, 1.0, 2.0]), np.full(3, 1.0 / 3.0), estimate) == spread


def test_an_estimate_lies_within_its_spread() -> None:
    """Grooves tighter than the grid of insides are reached by refining alone."""
    true = known(24, 9.525e-3, 25.0, False, 0.5075, 0.5085)
    found = estimate(
        **RINGS,
        contact_angle=true.contact_angle,
        hybrid=False,
        dynamic_rating=life.dynamic_rating(true),
        static_rating=life.static_rating(true),
        ball_diameter=true.ball_diameter,
        balls=true.balls,
    )
    assert found.inner_conformity < 0.508
    for name, (low, high) in found.spread.items():
        assert low <= getattr(found, name) <= high, name


def test_rings_alone_give_a_wide_estimate() -> None:
    found = estimate(**RINGS, contact_angle=math.radians(15.0))
    low, high = found.spread["ball_diameter"]
    assert high / low > 1.3
    assert found.explained == ()


def test_script_judges_a_catalogue(tmp_path: Path) -> None:
    """Rows of known bearings as a file: what the script prints of them is small."""
    head = ["code", "d_mm", "D_mm", "B_mm", "C0_kN"]
    classes = {"L": 100.0, "M": 300.0, "H": 600.0}
    for letter in classes:
        head += [f"Fv_{letter}_N", f"Kae_{letter}_N", f"Sa_{letter}_N_um"]
    with open(tmp_path / "rows.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(head)
        for code, bearing in zip(("B7014E", "B7014C", "HC7014C", "XC7014E"), KNOWN, strict=True):
            c0 = static_rating(insides(bearing), bearing.ball_material, STEEL)[0]
            row = [code, 70, 110, 20, f"{c0 / 1e3:.3f}"]
            for preload in classes.values():
                rigidity, unloading = solved(bearing, preload)
                row += [preload, f"{unloading:.1f}", f"{rigidity * 1e-6:.2f}"]
            table.writerow(row)
    script = [sys.executable, "-m", "benchmarks.estimates", str(tmp_path / "rows.csv")]
    done = subprocess.run(
        [*script, "--fitted", "M"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert "fitted on M: 4 rows, 0 refused" in done.stdout
    errors = [line.split() for line in done.stdout.splitlines() if "95th percentile" in line]
    assert len(errors) == 2
    assert all(float(line[2].rstrip("%,")) < 1.5 for line in errors)


def test_the_table_of_contacts_is_that_of_hertz() -> None:
    """Between its nodes, for conformities down to 0.500 001."""
    for ellipticity in np.exp(np.linspace(0.06, 7.9, 331)):
        where = -math.log1p(-curvature_difference(ellipticity))
        a, b, delta = dimensionless(ellipticity)
        assert np.exp(interpolated(where)) == pytest.approx([delta, a * b], rel=2e-8)


@pytest.mark.parametrize("known", KNOWN)
def test_the_likeliest_conformities_are_those_of_a_general_minimiser(known: Any) -> None:
    """Of values 2 % off those of one geometry; L-BFGS-B from the same starting points."""
    x, steel = Insides.of(known.grooves), known.ball_material
    scale = x.balls * contact_stiffness(x, steel, STEEL) * x.free_distance**1.5
    law = estimating.axial_law(x.contact_angle)
    preloads = (200.0, 600.0, 1200.0)
    rigidities = [
        float(off * estimating.pair_values(law, scale, x.free_distance, preload)[0])
        for off, preload in zip((0.98, 1.0, 1.02), preloads, strict=True)
    ]
    catalogue = Catalogue(
        **RINGS,
        contact_angle=x.contact_angle,
        ball_material=steel,
        preloads=preloads,
        rigidities=tuple(rigidities),
    )
    section = RINGS["outside_diameter"] - RINGS["bore"]

    def cost(values: Any, start: Insides) -> float:
        trial = start._replace(inner_conformity=values[0], outer_conformity=values[1])
        apart = estimating._apart(estimating._computed(trial, catalogue), catalogue)
        return float(0.5 * (apart**2).sum() - usual(trial, section))

    grid, likely, _ = estimating._weighed(catalogue)
    refined = estimating._refined(grid, likely, catalogue)
    every, likely = grid.spread_over(likely.shape), likely.ravel()
    step, best = estimating._STEP, math.inf
    order = np.argsort(-likely)
    pairs = np.stack([every.ball_diameter[order], every.balls[order]])
    _, first = np.unique(pairs, axis=1, return_index=True)
    for place in sorted(first)[: estimating._REFINED]:
        start = every.at(order[place])
        begin = [start.inner_conformity, start.outer_conformity]
        limits = [(max(f - step, TIGHTEST), f + step) for f in begin]
        best = min(best, minimize(cost, begin, (start,), "L-BFGS-B", bounds=limits).fun)
    found = cost((refined.inner_conformity, refined.outer_conformity), refined)
    assert found == pytest.approx(best, abs=1e-4)
    assert found < best + 1e-7
