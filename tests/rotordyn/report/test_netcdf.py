"""Datasets and the results file hold what the result dataclasses hold, bit for bit."""

from __future__ import annotations

import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import h5netcdf
import numpy as np
import pytest
import xarray as xr

from rotordyn.report import netcdf
from rotordyn.report.datasets import dataset
from rotordyn.report.netcdf import read_results, write_results
from rotordyn.report.variables import as_array
from rotordyn.results.declaration import declared
from tests.rotordyn.figures import samples

NAMES = ("preload", "campbell", "frf", "stiffness", "unbalance", "bearing")


@pytest.fixture(scope="module")
def path(tmp_path_factory, results) -> Path:
    file = tmp_path_factory.mktemp("nc") / "results.nc"
    write_results(file, results, {"case": "sample"})
    return file


def test_threads_write_files_at_the_same_time(tmp_path, results, monkeypatch):
    """Both are in memory before either is complete."""
    both = threading.Barrier(2, timeout=5.0)

    def late(*given, write=netcdf._write_group):
        if len(given[0].file) == 1:
            both.wait()
        write(*given)

    monkeypatch.setattr(netcdf, "_write_group", late)
    few = {name: results[name] for name in ("preload", "stiffness")}
    with ThreadPoolExecutor(2) as pool:
        list(pool.map(lambda name: write_results(tmp_path / name, few), ("a.nc", "b.nc")))
    assert [list(read_results(tmp_path / name)) for name in ("a.nc", "b.nc")] == [list(few)] * 2


@pytest.mark.parametrize("name", NAMES)
def test_datasets_are_read_alone(results, name):
    """What is written into one would be in the result as well; xarray makes new ones of it."""
    held = dataset(results[name])
    kept = held.copy(deep=True)
    for variable in held.variables.values():
        with suppress(ValueError):
            variable.values[...] = 0
    xr.testing.assert_identical(held, kept)
    xr.testing.assert_identical(dataset(results[name]), kept)
    speeds = kept.speed.values
    twice = 2.0 * held[[key for key in held if held[key].dtype.kind in "fc"]]
    twice.sel(speed=speeds[0]).load()
    twice.interp(speed=0.5 * (speeds[0] + speeds[-1])).load()
    for variable in held.copy(deep=True).data_vars.values():
        variable.values[...] = 0
    xr.testing.assert_identical(held, kept)


@pytest.mark.parametrize("name", NAMES)
def test_dataset_holds_every_declared_field(results, name):
    held = dataset(results[name])
    for key, info in declared(results[name]).items():
        place = info.metadata["dims"][0] if info.metadata["role"] == "coordinate" else key
        np.testing.assert_array_equal(held[place].values, as_array(getattr(results[name], key)))
        assert held[place].attrs["long_name"] == info.metadata["label"]


@pytest.mark.parametrize("name", NAMES)
def test_speed_comes_in_both_units(results, name):
    held = dataset(results[name])
    assert held.speed.attrs["units"] == "rad s-1"
    assert held.speed_rpm.attrs["units"] == "rpm"
    assert held.speed_rpm.values[-1] == pytest.approx(24000.0)
    assert "speed_rpm" in held.coords


@pytest.mark.parametrize("name", NAMES)
def test_reading_back_is_identical(path, results, name):
    xr.testing.assert_identical(read_results(path)[name], dataset(results[name]))


def test_complex_is_split_only_in_the_file(path, results):
    with xr.open_dataset(path, group="frf", engine="h5netcdf") as stored:
        assert "receptance" not in stored
        assert stored.receptance_re.attrs["complex_part"] == "real"
        assert stored.receptance_im.attrs["complex_name"] == "receptance"
        np.testing.assert_array_equal(stored.receptance_im, results["frf"].receptance.imag)
    assert dataset(results["frf"]).receptance.dtype == complex


@pytest.mark.parametrize("name", NAMES)
def test_foreign_readers_see_the_same(path, results, name):
    """xarray alone: every dimension, coordinate, value and attribute; complex in two halves."""
    held = dataset(results[name])
    with xr.open_dataset(path, group=name, engine="h5netcdf") as file:
        stored = file.load()
    assert {"speed", "speed_rpm"} <= set(stored.coords) == set(held.coords)
    for key in [key for key, v in held.items() if v.dtype.kind == "c"]:
        halves = stored[f"{key}_re"], stored[f"{key}_im"]
        assert [half.attrs.pop("complex_part") for half in halves] == ["real", "imaginary"]
        assert [half.attrs.pop("complex_name") for half in halves] == [key, key]
        assert halves[0].attrs == halves[1].attrs == held[key].attrs
        joined = (halves[0] + 1j * halves[1]).assign_attrs(halves[0].attrs)
        stored = stored.drop_vars([f"{key}_re", f"{key}_im"]).assign({key: joined})
    for v in stored.variables.values():
        assert v.attrs.pop("flag_meanings", "false true") == "false true"
        assert list(v.attrs.pop("flag_values", (0, 1))) == [0, 1]
    xr.testing.assert_identical(stored, held)


def test_not_a_number_and_negative_zero_survive(tmp_path):
    result = samples.frf(3, 5)
    values = result.receptance.copy()
    values[0, 0, 0], values[0, 0, 1] = complex(np.nan, 1.0), complex(-0.0, np.inf)
    write_results(tmp_path / "r.nc", {"frf": replace(result, receptance=values)})
    back = read_results(tmp_path / "r.nc")["frf"].receptance.values
    assert back.tobytes() == values.tobytes()


def test_machine_without_sleeves_and_critical_speeds(tmp_path):
    none = {f"critical_{n}": np.array([]) for n in ("speed", "order", "damping")}
    none |= {f"critical_{n}": () for n in ("kind", "whirl", "rotor")}
    none |= {"critical_excited": np.zeros(0, dtype=bool)}
    result = replace(samples.campbell(3), critical=(), **none)
    write_results(tmp_path / "r.nc", {"campbell": result})
    back = read_results(tmp_path / "r.nc")["campbell"]
    assert back.sizes["critical"] == 0
    xr.testing.assert_identical(back, dataset(result))
    with h5netcdf.File(tmp_path / "r.nc", "r") as file:
        growing = {n for n, d in file["campbell"].dimensions.items() if d.isunlimited()}
    assert growing == {d for d, n in back.sizes.items() if n == 0}  # as NetCDF has them
