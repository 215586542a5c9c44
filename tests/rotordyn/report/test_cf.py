"""A results file keeps the CF conventions: attributes of the file and of every variable."""

from __future__ import annotations

import math
import re
from pathlib import Path

import h5netcdf
import numpy as np
import pytest
import xarray as xr

from rotordyn.report import cf
from rotordyn.report.netcdf import write_results
from rotordyn.report.variables import variables
from rotordyn.results.declaration import declared

# Definitions of UDUNITS for the symbols of results; a number of its own for each, so that two
# spellings of a unit that give the same number are the same unit.
SYMBOLS = {"rad": 2.0, "s": 3.0, "N": 5.0, "m": 7.0, "Hz": 11.0, "Pa": 13.0, "kg": 17.0}
SYMBOLS |= {"degC": 41.0, "mm": 19.0, "min": 23.0, "rpm": 29.0, "W": 31.0, "J": 37.0}
ONE = re.compile(r"([A-Za-z]+)(-?[1-9])?")


def of_udunits(text: str) -> float:
    """The number of a unit written as UDUNITS reads it: symbols with powers between spaces."""
    if text == "1":
        return 1.0
    parts = [ONE.fullmatch(word) for word in text.split(" ")]
    assert all(parts), f"UDUNITS does not read {text}"
    return math.prod(SYMBOLS[part[1]] ** int(part[2] or 1) for part in parts)


def of_declaration(text: str) -> float:
    """The number of a unit as declarations write it, read as a formula of Python."""
    formula = text.replace("·", "*").replace("²", "**2")
    return float(eval(formula, {"__builtins__": {}}, SYMBOLS))


DECLARED = (
    "1", "rad/s", "N/m", "N·m/rad", "m/(N·m)", "(rad/s²)/(N·m)", "N/(rad/s)²", "mm/min", "kg·m",
    "Hz", "(m/s)/N",
)  # fmt: skip


@pytest.mark.parametrize("unit", DECLARED)
def test_units_mean_what_was_declared(unit: str) -> None:
    assert of_udunits(cf.units(unit)["units"]) == pytest.approx(of_declaration(unit), rel=1e-12)


def test_what_is_no_unit_is_refused() -> None:
    with pytest.raises(ValueError, match="not a unit: N°"):
        cf.units("N°")


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory, results) -> Path:
    file = tmp_path_factory.mktemp("cf") / "results.nc"
    write_results(file, results, cf.about("sample", "A sample", "0f"))
    return file


def test_file_says_what_it_is(path: Path) -> None:
    with h5netcdf.File(path, "r") as file:
        held = dict(file.attrs)
    assert held["Conventions"] == "CF-1.11"
    assert held["title"] == "A sample"
    assert re.fullmatch(r"rotordyn \S+", held["source"])
    assert re.match(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ rotordyn ", held["history"])
    assert "exp(+i omega t)" in held["sign_convention"]


def test_every_variable_is_described(path: Path) -> None:
    """Numbers with a unit or a list of units, responses with their sign, flags with meanings."""
    with h5netcdf.File(path, "r") as file:
        for group in file.groups.values():
            for name, variable in group.variables.items():
                _look_at(name, variable)


def _look_at(name: str, variable: h5netcdf.Variable) -> None:
    held = dict(variable.attrs)
    assert re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", name)
    assert held["long_name"]
    for unit in held.get("units", held.get("units_of_entries", "1")).split(", "):
        of_udunits(unit)
    numbers = variable.dtype.kind == "f"
    assert ("units" in held) != ("units_of_entries" in held) or not numbers, name
    assert ("complex_part" in held) == ("sign_convention" in held)
    if held.get("dtype") == "bool":
        assert held["flag_meanings"].split() == ["false", "true"]
        assert held["flag_values"].tolist() == [0, 1]
    if name.removesuffix("_rpm") in variable.dimensions:
        assert "_FillValue" not in held, "a coordinate has no missing values"
    elif numbers:
        assert np.isnan(held["_FillValue"])


def test_readers_without_rotordyn_see_what_it_writes(path: Path, results) -> None:
    """xarray alone: the two halves are the complex values, NaN stays NaN."""
    frf = results["frf"]
    with xr.open_dataset(path, group="frf", engine="h5netcdf") as stored:
        joined = stored.receptance_re.values + 1j * stored.receptance_im.values
    np.testing.assert_array_equal(joined, frf.receptance)


def test_units_of_pairs_are_in_their_order(results) -> None:
    frf = results["frf"]
    (attrs,) = (v.attrs for v in variables(frf) if v.name == "receptance")
    units = {cf.units(frf.unit(k))["units"] for k in range(len(frf.pair))}
    listed = attrs["units"] if len(units) == 1 else attrs["units_of_entries"]
    each = [cf.units(frf.unit(k))["units"] for k in range(len(frf.pair))]
    assert listed in (each[0], ", ".join(each))
    assert "SI, as computed" in {f.metadata["unit"] for f in declared(frf).values()}


def test_a_stiffness_says_its_frame(path: Path) -> None:
    with xr.open_dataset(path, group="preload", engine="h5netcdf") as preload:
        said = preload.stiffness.attrs["comment"]
        assert "in the frame of each bearing: x in the direction of its thrust" in said
