"""Spindles whose bearings have rings that deform: sizes, analyses that agree, refusals."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rotordyn
from bearings import ElasticRing
from rotordyn import InvalidInput
from rotordyn.job.solving import restricted
from rotordyn.machine import RingBodies
from tests.oracles.spindles import CASES

SPINDLE = """
title: rings
spindle: grinding_spindle
override:
  bearings.*.model: kh6014e
  growth: {static: 0 um}
  flexible_rings: {housing_diameter: 118 mm}
speeds: [0 rpm, 9000 rpm]
analyses:
"""


def written(folder: Path, analyses: str, more: str = "", text: str = SPINDLE) -> Path:
    path = folder / "rings.yaml"
    path.write_text(text + analyses + more, encoding="utf-8")
    return path


def both(folder: Path, analyses: str, more: str = "") -> Mapping[str, Any]:
    """Answers with rings that deform, and with rigid ones."""
    more += "\ncompare:\n  elastic: {}\n  rigid: {override: {bearings.*.flexible_rings: null}}\n"
    return rotordyn.run(rotordyn.load(written(folder, analyses, more)))


def test_sizes_are_those_of_the_model_and_of_the_shaft(tmp_path: Path) -> None:
    case = rotordyn.load(written(tmp_path, "  preload: {}\n"))
    spindle = case.spindle
    assert spindle is not None
    rings = spindle.mounted(spindle.seats[0]).rings
    assert rings is not None
    assert isinstance(rings.inner, ElasticRing)
    assert isinstance(rings.outer, ElasticRing)
    assert (rings.inner.width, rings.inner.seat_diameter) == pytest.approx((0.020, 0.070))
    assert rings.inner.backing_diameter == pytest.approx(0.030)
    assert rings.inner.backing_material == spindle.shaft.section_at(0.04).material
    assert (rings.outer.seat_diameter, rings.outer.backing_diameter) == pytest.approx(
        (0.110, 0.118)
    )
    usual = case.vary({"spindle.bearings.*.flexible_rings": RingBodies(
        bore_diameter=0.07, outside_diameter=0.11, width=0.02, which="outer"
    )})  # fmt: skip
    assert usual.spindle is not None
    rings = usual.spindle.mounted(usual.spindle.seats[1]).rings
    assert rings is not None
    assert rings.inner is None
    assert rings.outer is not None
    assert rings.outer.backing_diameter == pytest.approx(0.165)


def test_neighbours_are_equal_bearings_on_the_same_wall(tmp_path: Path) -> None:
    """Places as each bearing counts them, towards its own thrust; alike unless taken apart, on
    another sleeve, of another wall, or beyond the piece that deforms."""
    case = rotordyn.load(written(tmp_path, "  preload: {}\n"))

    def places(changes: Mapping[str, Any]) -> dict[str, tuple[list[float], list[float]]]:
        spindle = case.vary(changes).spindle
        assert spindle is not None
        found = {}
        for seat in spindle.seats:
            rings = spindle.mounted(seat).rings
            assert rings is not None
            both = [rings.inner, rings.outer]
            found[seat.name] = tuple(
                [
                    round(each.distance * 1e3, 6) * (-1 if each.mirrored else 1)
                    for each in ring.neighbours
                ]
                for ring in both
                if ring is not None
            )
        return found

    every = {"a": [22.0], "b": [-22.0], "c": [-22.0], "d": [22.0]}
    assert places({}) == {name: (each, each) for name, each in every.items()}
    assert case.spindle is not None
    seats = {seat.name: seat for seat in case.spindle.seats}
    first, last = (case.spindle.mounted(seats[name]).rings for name in "ad")
    assert first == last, "rounding of stations: computed once"
    one = "spindle.bearings.b.flexible_rings"
    rear = {name: (every[name], every[name]) for name in "cd"}
    none: tuple[list[float], list[float]] = ([], [])
    assert places({f"{one}.neighbours": "apart"}) == {"a": none, "b": none, **rear}
    assert places({f"{one}.length": "25 mm"}) == {"a": none, "b": none, **rear}
    short = {f"spindle.bearings.{name}.flexible_rings.length": "23 mm" for name in "abcd"}
    assert places(short) == dict.fromkeys("abcd", none)
    wall = {"a": (every["a"], []), "b": (every["b"], []), **rear}
    assert places({f"{one}.housing_diameter": "119 mm"}) == wall
    mirrored = places({"spindle.bearings.b.thrust": "-x"})
    assert mirrored == {"a": ([-22.0], [-22.0]), "b": ([-22.0], [-22.0]), **rear}
    alone = {"spindle.sleeves.rear.bearings": ["c"]}
    assert places(alone)["c"] == (every["c"], [])


def test_a_path_that_makes_rings_flexible_takes_their_sizes_from_the_model(tmp_path: Path) -> None:
    text = SPINDLE.replace("  flexible_rings: {housing_diameter: 118 mm}\n", "")
    case = rotordyn.load(written(tmp_path, "  preload: {}\n", text=text))
    changed = case.vary({"spindle.bearings.a.flexible_rings.housing_diameter": "118 mm"})
    assert changed.spindle is not None
    known = changed.spindle.seats[0].flexible_rings
    assert known is not None
    assert (known.bore_diameter, known.width) == pytest.approx((0.070, 0.020))
    assert changed.spindle.seats[1].flexible_rings is None


def test_every_analysis_sees_the_softer_bearings(tmp_path: Path) -> None:
    analyses = (
        "  preload: {}\n"
        "  campbell: {max_frequency: 1500 Hz}\n"
        "  frf: {frequencies: [10 Hz], pairs: [{response: nose.y, excitation: nose.y}]}\n"
        "  stiffness: {point: nose, max_force: 100 N, variants: [nonlinear, full]}\n"
        "  static_sag: {point: nose}\n"
    )
    results = both(tmp_path, analyses)
    soft, stiff = (
        {name: results[f"{v}/{name}"] for name in ("campbell", "frf", "stiffness", "static_sag")}
        for v in ("elastic", "rigid")
    )
    found, known = (each["campbell"].frequency.values for each in (soft, stiff))
    ratio = found[..., 0] / known[..., 0]
    assert ((ratio < 0.998) & (ratio > 0.9)).all()
    low, high = (np.abs(each["frf"].receptance.values).max() for each in (soft, stiff))
    assert low > 1.01 * high
    # The nonlinear curve begins with the stiffness of the linear machine.
    linear, full = (
        soft["stiffness"].tangent.sel(variant=word).values for word in ("full", "nonlinear")
    )
    assert full == pytest.approx(linear, rel=2e-4)
    assert (full < 0.99 * stiff["stiffness"].tangent.sel(variant="nonlinear").values).all()


def test_rings_of_one_bearing_alone(tmp_path: Path) -> None:
    text = SPINDLE.replace("  flexible_rings:", "  bearings.a.flexible_rings:")
    case = rotordyn.load(written(tmp_path, "  bearing_loads: {}\n", text=text))
    loads = rotordyn.run(case)["bearing_loads"]
    outer = loads.outer_ring_deflection.values
    assert (outer[:, 0] > 1e-8).all()
    assert np.nanmax(np.abs(outer[:, 1:])) == 0.0


@pytest.mark.long
def test_small_motion_over_time_is_that_of_linear_bearings(tmp_path: Path) -> None:
    analyses = (
        "  time_response: {duration: 5 ms, max_frequency: 2 kHz, points: [nose], forces: "
        "[{at: nose, direction: y, force: 1 N, pulse: 1 ms}]}\n"
    )
    text = SPINDLE.replace("speeds: [0 rpm, 9000 rpm]", "speeds: [9000 rpm]")
    case = rotordyn.load(written(tmp_path, analyses, text=text))
    found = rotordyn.run(case)["time_response"]
    whole, linear = found.displacement.values, found.linear_displacement.values
    assert np.abs(whole - linear).max() < 1e-3 * np.abs(linear).max()
    assert np.abs(linear).max() > 0.0


def test_how_far_rings_give_is_said(tmp_path: Path) -> None:
    load = "conditions: {loads: [{at: nose, Fy: 500 N}]}\n"
    results = rotordyn.run(rotordyn.load(written(tmp_path, "  bearing_loads: {}\n", load)))
    (note,) = (line for line in results.notes if "rings deform" in line)
    assert "bearing a" in note
    assert "d " in note
    largest = results["bearing_loads"].ball_inner_load.max("ball").values
    pairs = largest.reshape(2, 2, 2)  # speeds, pairs, bearings
    apart = 100.0 * (np.ptp(pairs, axis=2) / pairs.max(axis=2)).max()
    pair = f"(largest ball loads up to {apart:.0f} % apart)"
    assert f"a and b, c and d on common walls as if loaded alike {pair}" in note
    alone = written(
        tmp_path, "  preload: {}\n", text=SPINDLE.replace("118 mm", "118 mm, neighbours: apart")
    )
    (note,) = (line for line in rotordyn.run(rotordyn.load(alone)).notes if "rings deform" in line)
    assert "every bearing with separate walls" in note


SINGLE = """
title: one bearing
bearing: lacroix_r24_14
speeds: [1500 rpm]
analyses:
  bearing:
    loads: [20 kN]
    flexible_rings: {bore_diameter: 128 mm, outside_diameter: 189 mm, width: 24 mm, SHAFT}
"""


def test_a_single_bearing_says_how_far_its_raceways_give(tmp_path: Path) -> None:
    text = SINGLE.replace("SHAFT", "shaft_bore: 118 mm, housing_diameter: 199 mm")
    result = rotordyn.run(rotordyn.load(written(tmp_path, "", text=text)))
    found = result["bearing"].ring_deflection.values[0, 0, 0] * 1e6
    assert found.shape == (4,)
    assert ((found > -5.0) & (found < 15.0)).all()
    assert found.max() > 3.0
    assert "raceway by" in result.summary


REFUSED = {
    "housing": ("housing_diameter: 100 mm", "flexible_rings.housing_diameter"),
    "word": ("which: all", "allowed: both, inner, outer"),
    "narrow": ("width: 2 mm, which: inner", "balls"),
    "bore": ("bore_diameter: 85 mm", "no ring"),
    "hole": ("shaft_bore: 70 mm", "leaves no shaft under the ring"),
    "short": ("length: 10 mm", "shorter than the ring"),
    "key": ("thickness: 4 mm", "unknown key"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_impossible_rings_are_refused_with_their_key(name: str, tmp_path: Path) -> None:
    given, words = REFUSED[name]
    text = SPINDLE.replace("housing_diameter: 118 mm", given)
    with pytest.raises(InvalidInput) as refusal:
        rotordyn.load(written(tmp_path, "  preload: {}\n", text=text))
    assert words in str(refusal.value)
    assert "rings.yaml" in str(refusal.value)


def test_balls_do_not_expand_the_outer_ring_twice(tmp_path: Path) -> None:
    more = "  fits: {shaft: k5, housing: JS5, under_balls: true}\n  flexible_rings:"
    text = SPINDLE.replace("  flexible_rings:", more)
    with pytest.raises(InvalidInput, match="which the balls expand already"):
        rotordyn.load(written(tmp_path, "  preload: {}\n", text=text))


def test_a_single_bearing_needs_the_hole_of_its_shaft(tmp_path: Path) -> None:
    text = SINGLE.replace(", SHAFT", "")
    with pytest.raises(InvalidInput, match="shaft_bore"):
        rotordyn.load(written(tmp_path, "", text=text))


def test_the_shipped_case_of_thin_walls_shows_what_they_take() -> None:
    case = rotordyn.load(CASES / "grinding_spindle_rings.yaml")
    stiffness = {}
    for name in ("rigid", "apart", "cartridge"):
        asked = restricted(case.variants[name], ("stiffness",))
        results = rotordyn.run(rotordyn.vary(asked, {"speeds": case.speeds[-1:]}))
        stiffness[name] = float(results["stiffness"].tangent[-1, 0])
    assert 0.85 < stiffness["apart"] / stiffness["rigid"] < 0.95
    assert stiffness["cartridge"] / stiffness["rigid"] > 0.85
    assert stiffness["cartridge"] < 0.99 * stiffness["apart"]


def test_a_thin_wall_is_reported_where_rings_are_taken_as_rigid(tmp_path: Path) -> None:
    text = SPINDLE.replace("  flexible_rings: {housing_diameter: 118 mm}\n", "  FITS\n")
    words = "are modelled as rigid"
    for housing, told in (("118 mm", True), ("160 mm", False)):
        fits = f"fits: {{shaft: k5, housing: JS5, housing_diameter: {housing}}}"
        case = rotordyn.load(written(tmp_path, "  preload: {}\n", text=text.replace("FITS", fits)))
        warnings = [line for line in rotordyn.run(case).warnings if words in line]
        assert bool(warnings) == told
        assert all("a (4 mm of housing)" in line for line in warnings)
    elastic = text.replace("FITS", f"{fits}\n  flexible_rings: {{}}")
    elastic = elastic.replace("160 mm", "118 mm")
    case = rotordyn.load(written(tmp_path, "  preload: {}\n", text=elastic))
    assert not [line for line in rotordyn.run(case).warnings if words in line]
    spindle = case.spindle
    assert spindle is not None
    rings = spindle.mounted(spindle.seats[0]).rings
    assert rings is not None
    assert rings.outer is not None
    assert rings.outer.backing_diameter == pytest.approx(0.118)


def test_fits_and_rings_share_one_housing(tmp_path: Path) -> None:
    text = SPINDLE.replace(
        "  flexible_rings:", "  fits: {shaft: k5, housing: JS5}\n  flexible_rings:"
    )
    with pytest.raises(InvalidInput, match="share one housing: give it as fits"):
        rotordyn.load(written(tmp_path, "  preload: {}\n", text=text))


def test_films_are_in_series_with_elastic_rings(tmp_path: Path) -> None:
    oil = "{viscosity_40: 32 mm^2/s, viscosity_100: 5.4 mm^2/s, temperature: 50 degC}"
    ratio = []
    for films in (f"conditions: {{films: {oil}}}\n", ""):
        results = both(tmp_path, "  campbell: {max_frequency: 1500 Hz}\n", films)
        soft, stiff = (
            results[f"{v}/campbell"].frequency.values[1, 0] for v in ("elastic", "rigid")
        )
        ratio.append(soft / stiff)
    assert ratio[0] == pytest.approx(ratio[1], abs=2e-3)
    assert ratio[0] < 0.995


@pytest.mark.parametrize(("taken", "told"), [("mean", True), ("most", False)])
def test_play_of_a_ring_that_deforms_with_its_housing_is_reported(
    taken: str, told: bool, tmp_path: Path
) -> None:
    fits = f"  fits: {{shaft: k5, housing: JS5, taken: {taken}, housing_diameter: 130 mm}}\n"
    text = SPINDLE.replace("  flexible_rings: {housing_diameter: 118 mm}\n", fits)
    text = text.replace("speeds:", "  flexible_rings: {}\nspeeds:")
    results = rotordyn.run(rotordyn.load(written(tmp_path, "  preload: {}\n", text=text)))
    assert bool([w for w in results.warnings if "has clearance in its housing" in w]) == told
