"""What variants differ in: paths, units, values; the table of their headline numbers."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import rotordyn
from rotordyn.case.varied import usual_unit, varied
from rotordyn.job.side_by_side import scale_of, write_comparison
from rotordyn.quantity import Quantity
from rotordyn.results.headline import Number, cells, changes, each_speed
from rotordyn.results.text import over_speed


def springs() -> list[rotordyn.Case]:
    return list(rotordyn.load("mfw2310_preload_springs").variants.values())


def test_what_differs_has_its_path_and_a_usual_unit() -> None:
    stiffness, travel = varied(springs())
    assert stiffness.label == "spindle.sleeves.front.spring.stiffness [N/um]"
    assert stiffness.values == (3.1, 6.2, 12.4, 24.8, 6.2)
    assert stiffness.numeric
    assert travel.path == "spindle.sleeves.front.stop_travel"
    assert not travel.numeric, "none is no number"


def test_speeds_are_in_rpm_whatever_their_size() -> None:
    quantity = Quantity("speed")
    assert {usual_unit(quantity, [rpm * math.pi / 30.0]) for rpm in (0.1, 30.0, 8000.0, 3e5)} == {
        "rpm"
    }


def test_the_path_is_that_of_vary() -> None:
    first, other, *_ = springs()
    (found,) = varied([first, other])
    made = first.vary({found.path: f"{found.values[1]} {found.unit}"})
    assert not varied([made, other])


def test_the_path_of_an_entry_that_couples_is_that_of_vary() -> None:
    case = rotordyn.load("friswell_coaxial")
    assert case.spindle is not None
    way = f"spindle.supports.{case.spindle.supports[0].name}.stiffness.y_thz"
    first, other = (case.vary({way: value}) for value in ("1 N/rad", "2 N/rad"))
    assert [each.path for each in varied([first, other])] == [way]


def test_colours_have_a_scale_where_one_number_was_varied() -> None:
    scale = scale_of(springs()[:4])
    assert scale is not None
    assert list(scale.values) == [3.1, 6.2, 12.4, 24.8]
    assert scale_of(springs()) is None, "the stop was taken away, too"


def test_entries_that_vary_in_step_are_one_scale() -> None:
    cases = rotordyn.load("friswell_unbalance").variants.values()
    scale = scale_of(list(cases))
    assert scale is not None
    assert scale.label == "spindle.supports.left.stiffness.yy [N/um]"


def test_parts_and_speeds_of_a_number_share_a_cell() -> None:
    numbers = [
        Number("bending 1", "Hz", 903.41, "backward", 0.0),
        Number("bending 1", "Hz", 903.41, "forward", 0.0),
        Number("bending 1", "Hz", 460.7, "backward", 24000.0),
        Number("bending 1", "Hz", 466.84, "forward", 24000.0),
        Number("tip", "µm", np.inf),
    ]
    words = {"bending 1 [Hz]": "903.4 → 460.7/466.8", "tip [µm]": "unbounded"}
    assert cells(numbers) == words
    assert numbers[3].heading == "bending 1 forward at 24000 rpm [Hz]"


def test_what_lies_beyond_both_ends_of_the_speeds_is_said() -> None:
    """As a hole of stiffness where a spring unloads; not what rounding, or little, is beyond."""
    speed = np.array([0.0, 300.0, 600.0, 900.0])

    def words(values: list[float]) -> str:
        result = SimpleNamespace(speed=speed)
        return cells(each_speed(result, "full", "N/µm", np.array(values)))["full [N/µm]"]

    assert words([94.1, 9.8, 7.71, 13.7]) == "94.1 → 13.7 (least 7.71)"
    assert words([94.1, 50.0, 120.0, 13.7]) == "94.1 → 13.7 (most 120.0)"
    assert words([94.1, 3.0, 120.0, 13.7]) == "94.1 → 13.7 (least 3.00, most 120.0)"
    assert words([94.1, 95.0, 13.0, 13.7]) == "94.1 → 13.7"
    assert words([np.nan, 95.0, np.nan, 13.7]) == "none → 13.7 (most 95.0)"
    assert words([np.nan, np.inf, np.nan, np.nan]) == "none → none"
    assert over_speed(np.array([-50.0, -9.0, -70.0, -20.0]), speed, 0) == (
        "-50.0 → -20.0 (least -70.0 at 5730 rpm, most -9 at 2865 rpm)"
    )
    parts = [
        Number("pair", "Hz", value, way, rpm, inner=rpm == 500.0)
        for rpm, pair in ((0.0, (9.0, 9.0)), (500.0, (6.0, 4.0)), (900.0, (7.0, 8.0)))
        for way, value in zip(("backward", "forward"), pair, strict=True)
    ]
    assert cells(parts)["pair [Hz]"] == "9.00 → 7.00/8.00 (least 4.00)"


def test_changes_are_relative_to_the_first() -> None:
    found = changes({"a": 3.0, "b": 1.0, "c": np.nan, "d": 2.0}, {"a": 2.0, "b": 0.0, "c": 1.0})
    assert found["a"] == pytest.approx(50.0)
    assert all(np.isnan(found[name]) for name in "bcd")


def test_the_table_has_a_row_for_each_variant(tmp_path: Path) -> None:
    whole = rotordyn.load("friswell_unbalance").vary({"speeds": (0.0, 100.0, 200.0)})
    parts = rotordyn.run(whole).parts
    write_comparison(tmp_path, parts)
    with (tmp_path / "variants.csv").open(encoding="utf-8-sig") as file:
        rows = list(csv.DictReader(file))
    assert [row["variant"] for row in rows] == ["even", "uneven"]
    assert [row["spindle.supports.left.stiffness.yy [N/um]"] for row in rows] == ["1.0", "0.8"]
    size = [float(row["unbalance: left_disc [µm]"]) for row in rows]
    with (tmp_path / "variants_change.csv").open(encoding="utf-8-sig") as file:
        second = list(csv.DictReader(file))[1]
    change = float(second["unbalance: left_disc, change [%]"])
    assert change == pytest.approx(100.0 * (size[1] / size[0] - 1.0), abs=1e-4)
