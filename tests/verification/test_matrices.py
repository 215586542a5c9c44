"""The exported matrices are the machine: its receptances, its poles, its motion over time."""

from __future__ import annotations

import csv
import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.io import loadmat

import rotordyn
from rotordyn.analyses import CampbellSpec, FrfSpec, MatricesSpec, TimeResponseSpec
from rotordyn.analyses.matrices import solve
from rotordyn.analyses.matrices.figures import headline_curves
from rotordyn.analyses.matrices.figures.ports import ports_figure
from rotordyn.analyses.matrices.summary import numbers, warnings
from rotordyn.analyses.measured_response import Port
from rotordyn.analyses.time_response.spec import ForceOverTime
from rotordyn.errors import InvalidInput
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.support import LinearSupport
from rotordyn.results.described import Shown
from rotordyn.scene.conditions import Conditions
from tests.oracles.rotors import support, uniform

RPM = math.pi / 30.0
MACHINES = {  # name of a case -> ports, highest frequency [Hz]
    "grinding_spindle_sag": (("nose.y", "nose.z", "nose.thz", "nose.x"), 3000.0),
    "friswell_oil_films": (("right_disc.y", "right_disc.z", "left_disc.y"), 120.0),
    "friswell_coaxial": (("disc1.y", "disc1.z", "outer.disc2.y", "outer.disc2.z"), 400.0),
    "driveline_shaft": (("A.y", "B.z", "B.thx"), 4000.0),
    "squeeze_film_damper": (("left_disc.y", "right_disc.z"), 150.0),
}


def port(words: str) -> Port:
    point, _, direction = words.rpartition(".")
    return Port(point, direction)


def asked(name: str, **analyses: Any) -> Any:
    """A shipped case with the ports of its machine and further analyses, at two speeds."""
    ports, highest = MACHINES[name]
    spec = MatricesSpec(highest, tuple(map(port, ports)))
    given = rotordyn.load(name)
    top = {"driveline_shaft": 3000.0, "friswell_oil_films": 1500.0}.get(name, 3000.0) * RPM
    low = 500.0 * RPM if name == "friswell_oil_films" else 0.0
    case = replace(given, analyses={"matrices": spec, **analyses}, speeds=(low, top), variants={})
    return replace(case, references=())


def state_space(data: Any, row: int) -> Any:
    """A of ẋ = A x, x = (q, q̇)."""
    n = data.sizes["row"]
    k, c = data.stiffness.values[row], data.damping.values[row]
    return np.block([[np.zeros((n, n)), np.eye(n)], [-k, -c]])


@pytest.mark.parametrize("name", MACHINES)
def test_receptances_between_all_ports_are_those_of_frf(name: str) -> None:
    ports, highest = MACHINES[name]
    lateral = [each for each in ports if each[-2:] in (".y", ".z")]
    pairs = tuple((port(one), port(other)) for one in lateral for other in lateral)
    frequency = np.linspace(0.013, 0.97, 9) * highest
    results = rotordyn.run(asked(name, frf=FrfSpec(tuple(frequency), pairs)))
    data, known = results["matrices"], results["frf"].receptance.values
    places = [ports.index(each) for each in lateral]
    motion = data.motion.values[places]
    for row in range(2):
        for k, hertz in enumerate(frequency):
            s = 2j * math.pi * hertz
            dynamic = data.stiffness.values[row] + s * data.damping.values[row]
            found = motion @ np.linalg.solve(dynamic + s**2 * np.eye(len(dynamic)), motion.T)
            expected = known[row, :, k].reshape(found.shape)
            assert found == pytest.approx(expected, rel=1e-6, abs=1e-7 * np.abs(expected).max())


@pytest.mark.parametrize("name", MACHINES)
def test_poles_are_those_of_campbell(name: str) -> None:
    _, highest = MACHINES[name]
    results = rotordyn.run(asked(name, campbell=CampbellSpec(highest)))
    data, modes = results["matrices"], results["campbell"]
    kinds = {"grinding_spindle_sag": "axial", "driveline_shaft": "torsion"}
    kept = np.isin(modes.kind.values, ("bending", kinds.get(name)))
    for row in range(2):
        found = np.linalg.eigvals(state_space(data, row))
        for pole in modes.pole.values[row, kept]:
            if np.isfinite(pole) and pole.imag <= 2.0 * math.pi * highest:
                away = np.abs(found - pole).min() / abs(pole)
                assert away < 1e-5, pole


def test_damping_holds_the_gyroscopic_effect_times_speed() -> None:
    """Of supports that do not follow the speed nothing else changes."""
    data = rotordyn.run(asked("friswell_coaxial"))["matrices"]
    low, high = data.damping.values
    speed = float(data.speed[1])
    size = np.abs(high).max()
    assert high - low == pytest.approx(speed * data.gyroscopic.values, abs=1e-10 * size)
    assert data.gyroscopic.values == pytest.approx(-data.gyroscopic.values.T, abs=1e-12)


def test_motion_over_time_is_that_of_time_response() -> None:
    """A half sine on the nose, integrated by another method."""
    size, pulse, duration = 300.0, 2e-3, 6e-3
    force = ForceOverTime("nose", "y", force=size, pulse=pulse)
    spec = TimeResponseSpec(duration, 3000.0, ("nose",), (force,))
    results = rotordyn.run(asked("grinding_spindle_sag", time_response=spec))
    data, known = results["matrices"], results["time_response"]
    motion, n = data.motion.values, data.sizes["row"]
    a, time = state_space(data, 1), known.time.values

    def slope(t: float, x: Any) -> Any:
        acting = size * math.sin(math.pi * t / pulse) if t < pulse else 0.0
        return a @ x + np.concatenate([np.zeros(n), motion[0] * acting])

    answer = solve_ivp(
        slope, (0.0, duration), np.zeros(2 * n), "LSODA", t_eval=time, rtol=1e-8, atol=1e-13
    )
    found = motion[:2] @ answer.y[:n]
    expected = known.linear_displacement.values[1, :, 0, 1:].T
    assert found == pytest.approx(expected, abs=1e-4 * np.abs(expected).max())


def test_receptances_of_the_result_are_those_of_its_matrices_up_to_their_peaks() -> None:
    data = rotordyn.run(asked("grinding_spindle_sag"))["matrices"]
    for place, row in enumerate((0, 1)):
        s = 2j * math.pi * float(data.frequency[40])
        dynamic = data.stiffness.values[row] + s * data.damping.values[row]
        motion = data.motion.values
        found = motion @ np.linalg.solve(dynamic + s**2 * np.eye(len(dynamic)), motion.T)
        assert np.diag(found) == pytest.approx(data.receptance.values[place, :, 40], rel=1e-9)
    ports = (("nose.y", "nose.y"),)
    pairs = tuple((port(a), port(b)) for a, b in ports)
    frequency = tuple(np.linspace(10.0, 3000.0, 100))
    frf = rotordyn.run(asked("grinding_spindle_sag", frf=FrfSpec(frequency, pairs)))["frf"]
    highest = np.abs(data.receptance.values[:, 0]).max(axis=1)
    assert highest == pytest.approx(
        np.nanmax(np.abs(frf.peak_value.values[:, 0]), axis=1), rel=0.01
    )


def test_lines_between_the_samples_of_receptances_follow_them() -> None:
    """In straight lines of their logarithm, up to the highest frequency and no farther."""
    data = rotordyn.run(asked("grinding_spindle_sag"))["matrices"]
    known, motion = data.frequency.values, data.motion.values
    assert (np.diff(known) > 0.0).all()
    assert known[-1] == float(data.max_frequency)
    fine = np.linspace(known[0], known[-1], 3001)
    for row in range(2):
        k, c = data.stiffness.values[row], data.damping.values[row]
        exact = [
            motion[0] @ np.linalg.solve(k + s * c + s * s * np.eye(len(k)), motion[0])
            for s in 2j * math.pi * fine
        ]
        drawn = np.interp(fine, known, np.log(np.abs(data.receptance.values[row, 0])))
        assert np.abs(drawn - np.log(np.abs(exact))).max() < 0.1


def test_numbers_and_figures_show_the_receptance_of_each_port_at_its_speed() -> None:
    results = rotordyn.run(asked("grinding_spindle_sag"))
    part = results.parts[""]
    result = part.results["matrices"]
    size = np.abs(result.receptance)
    values = {each.words: (each.value, each.unit) for each in numbers(result, part.case)}
    axes = ports_figure(result).axes
    curves = [*headline_curves(None, Shown("", result, (), None))]
    for k, name in enumerate(result.port):
        unit, factor = ("rad/(N·m)", 1.0) if name.endswith("thz") else ("µm/N", 1e6)
        for row, rpm in enumerate((0, 3000)):
            highest = pytest.approx(size[row, k].max() * factor)
            assert values[f"{name} at {rpm} rpm"] == (highest, unit)
            drawn = axes[k].get_lines()[row].get_ydata()
            assert drawn == pytest.approx(size[row, k] * factor)
        assert axes[k].get_ylabel() == f"amplitude [{unit}]"
        assert curves[k].y == pytest.approx(size[-1, k] * factor)
        assert (curves[k].panel, curves[k].unit) == (name, unit)


def test_a_speed_without_a_state_has_no_matrices() -> None:
    machine = rotordyn.load("deep_groove_lobes").variants["at_speed"]
    spec = MatricesSpec(2000.0, (port("nose.y"),))
    speeds = (0.0, 3000.0 * RPM, 110000.0 * RPM)
    results = rotordyn.run(replace(machine, analyses={"matrices": spec}, speeds=speeds))
    assert "1 port at 2 speeds" in " ".join(results.summary.split())
    data = results["matrices"]
    assert data.outcome.values[:2].tolist() == ["", ""]
    assert "unloaded at 110000 rpm" in str(data.outcome.values[2])
    for each in (data.stiffness, data.damping):
        assert np.isnan(each.values).any(axis=(1, 2)).tolist() == [False, False, True]
    assert data.shown_speed.values == pytest.approx(speeds[:2])
    assert np.isfinite(data.receptance.values).all()


def test_what_grows_and_what_nothing_damps_is_warned_of() -> None:
    for name, speed, words in (
        ("friswell_oil_films", 3000.0, "unstable at 2 of 2 speeds, first at 2500 rpm"),
        ("friswell_cross_coupled", 3000.0, "the machine is undamped"),
    ):
        given = rotordyn.load(name)
        assert given.spindle is not None
        spec = MatricesSpec(120.0, (Port(next(iter(given.spindle.places)), "y"),))
        speeds = (2500.0 * RPM, speed * RPM)
        case = replace(given, analyses={"matrices": spec}, speeds=speeds, variants={})
        assert any(words in each for each in rotordyn.run(replace(case, references=())).warnings)


def of_shaft(port: str, *supports: LinearSupport) -> Any:
    """Matrices of a shaft of 0.6 m up to 2 kHz, with a port at its front end."""
    shaft = replace(uniform(0.6, 0.06, supports=supports), points={"nose": 0.0})
    spec = MatricesSpec(2000.0, (Port("nose", port),))
    case = replace(
        asked("friswell_coaxial"),
        spindle=shaft,
        conditions=Conditions(),
        analyses={"matrices": spec},
    )
    return shaft, rotordyn.run(case)


def test_peaks_far_below_the_highest_frequency_are_found() -> None:
    """Of a shaft on an axial spring, which it oscillates on at 1.4 Hz."""
    size, damping, radial = 1e3, 10.0, {("y", "y"): 2e7, ("z", "z"): 2e7}
    front = LinearSupport("front", 0.1, {**radial, ("x", "x"): size}, {("x", "x"): damping})
    shaft, results = of_shaft("x", front, LinearSupport("rear", 0.5, radial))
    omega = math.sqrt(size / rotor_inertia(shaft).mass)
    highest = np.abs(results["matrices"].receptance.values[0]).max()
    assert highest == pytest.approx(1.0 / (damping * omega), rel=2e-2)


def test_panels_show_receptances_of_machines_without_damping() -> None:
    """Of a free shaft, between its peaks, which have no height."""
    _, results = of_shaft("y", support("free", 0.1, (1e-15, 1e-15)))
    result = results.parts[""].results["matrices"]
    (axes,) = ports_figure(result).axes
    low, high = axes.get_ylim()
    drawn = 1e6 * np.abs(result.receptance[0, 0])
    even = np.isin(result.frequency, np.linspace(0.0, 2000.0, 201))
    assert np.mean((low < drawn[even]) & (drawn[even] < high)) > 0.5
    assert drawn.max() < 1e6 * high


def test_a_file_of_matlab_holds_them(tmp_path: Path) -> None:
    results = rotordyn.run(asked("friswell_oil_films"))
    results.save(tmp_path / "o", figures=False)
    held = loadmat(tmp_path / "o" / "matrices.mat", simplify_cells=True)
    data = results["matrices"]
    assert held["K"] == pytest.approx(np.moveaxis(data.stiffness.values, 0, -1))
    assert held["C"] == pytest.approx(np.moveaxis(data.damping.values, 0, -1))
    assert held["G"] == pytest.approx(data.gyroscopic.values)
    assert held["L"] == pytest.approx(data.motion.values)
    assert (held["M"] == np.eye(data.sizes["row"])).all()
    assert held["speed"] == pytest.approx(data.speed.values)
    assert [*held["ports"]] == [*data.port.values]


def test_tables_and_dataset_tell_the_unit_of_every_port(tmp_path: Path) -> None:
    results = rotordyn.run(asked("grinding_spindle_sag"))
    results.save(tmp_path, figures=False)
    data = results["matrices"]
    with (tmp_path / "matrices_receptance.csv").open(encoding="utf-8-sig", newline="") as file:
        head, *rows = csv.reader(file)
    cells = np.array(rows, dtype=float).T
    for k, name in enumerate(data.port.values):
        unit, factor = ("rad/(N·m)", 1.0) if name.endswith("thz") else ("µm/N", 1e6)
        column = cells[head.index(f"receptance {name} real [{unit}]")]
        known = data.receptance.values[:, k].real.ravel() * factor
        assert column == pytest.approx(known, rel=1e-6)
    with (tmp_path / "matrices_ports.csv").open(encoding="utf-8-sig", newline="") as file:
        motion = next(csv.reader(file))[-1]
    assert motion == "motion of the port per unit of the coordinate [1/√kg, rad/(m √kg)]"
    assert data.stiffness.attrs["units"] == "s-2"
    assert data.damping.attrs["units"] == "s-1"
    assert "units" not in data.motion.attrs


def test_errors_are_reported_and_warned_of() -> None:
    coarse = rotordyn.run(asked("grinding_spindle_sag"))
    data = coarse["matrices"]
    assert 0.0 < float(data.frequency_error) < 1e-4
    assert 0.0 < float(data.receptance_error) < 1e-3
    assert "frequencies of the matrices within" in coarse.summary
    result = coarse.parts[""].results["matrices"]
    assert warnings(result) == []
    for error in ({"receptance_error": 2e-2}, {"frequency_error": 2e-2}):
        (sentence,) = warnings(replace(result, **error))
        assert "2e-02" in sentence


@pytest.mark.parametrize("errors", [(1e-4, 0.0), (0.0, 1e-3)], ids=["poles", "receptances"])
def test_the_model_is_refined_where_either_error_is_too_large(
    errors: tuple[float, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Once; a relative error of poles counts ten times."""
    found, told = [], [(0.0, 0.0), errors, (0.0, 0.0)]
    monkeypatch.setattr(solve, "_errors", lambda spec, scene: told.pop(0))
    for _ in range(2):
        case = asked("friswell_coaxial")
        case = replace(
            case, conditions=replace(case.conditions, accuracy=5e-5, element_length=None)
        )
        found.append(rotordyn.run(case)["matrices"].sizes["column"])
    assert not told
    assert found[1] > found[0]


def test_the_error_of_poles_counts_those_that_either_model_lacks() -> None:
    """Those of the finer one just below the highest frequency apart; slow ones over a thousandth of
    that frequency."""

    def error(coarse: tuple[float, ...], fine: tuple[float, ...]) -> float:
        one, other = (
            SimpleNamespace(pole=2j * math.pi * np.array([[*hertz, math.nan]]))
            for hertz in (coarse, fine)
        )
        scene: Any = SimpleNamespace(
            usable=[0],
            speed=np.zeros(1),
            spindle=SimpleNamespace(supports=()),
            owner=lambda *_: 0,
            system_at=lambda *_: one,
            refined=SimpleNamespace(system_at=lambda *_: other),
        )
        spec = MatricesSpec(500.0, (port("nose.y"),))
        return solve._pole_error(scene, spec, 2.0 * math.pi * 500.0)

    assert error((100.0, 400.0), (100.1, 400.0)) == pytest.approx(1e-3)
    assert error((100.0, 250.0, 400.0), (100.0, 400.0)) == pytest.approx(0.6)
    assert error((100.0, 400.0), (100.0, 250.0, 400.0)) == pytest.approx(0.6)
    assert error((100.0, 400.0), (100.0, 400.0, 480.0)) == 0.0
    assert error((0.1, 400.0), (0.2, 400.0)) == pytest.approx(0.2)


@pytest.mark.parametrize("name", ["friswell_coaxial", "grinding_spindle_sag"])
def test_reported_errors_are_the_true_ones(name: str) -> None:
    """Against a model of 10⁻⁸, of a coarse one."""
    case, found = asked(name), {}
    for accuracy in (1e-2, 1e-8):
        conditions = replace(case.conditions, accuracy=accuracy, element_length=None)
        data = rotordyn.run(replace(case, conditions=conditions))["matrices"]
        omega = 2.0 * math.pi * float(data.max_frequency) * np.arange(1, 31) / 30.0
        motion, unit = data.motion.values, np.eye(data.sizes["row"])
        found[accuracy] = (
            float(data.receptance_error),
            np.array(
                [
                    motion @ np.linalg.solve(k + s * c + s * s * unit, motion.T)
                    for k, c in zip(data.stiffness.values, data.damping.values, strict=True)
                    for s in omega * (1j + 0.05)
                ]
            ),
        )
    (told, coarse), (_, fine) = found[1e-2], found[1e-8]
    size, off = np.abs(fine).max(axis=0), np.abs(coarse - fine).max(axis=0)
    true = float((off / np.maximum(size, 1e-6 * size.max())).max())
    assert 1e-5 < true < 1e-2
    assert true / 3.0 < told < 3.0 * true


CASE = """
spindle: grinding_spindle
speeds: [0 rpm]
analyses: {matrices: {max_frequency: 2 kHz, ports: [nose.y]}}
"""


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("[nose.y]", "[nowhere.y]", "unknown point"),
        ("[nose.y]", "[nose.q]", "allowed: x, y, z"),
        ("[nose.y]", "[nose.y, nose.y]", "repeated"),
        ("[nose.y]", "[]", "at least one"),
        ("speeds", "conditions: {formulation: rotating}\nspeeds", "formulation: inertial"),
        ("speeds", "override: {damping.loss_factor: 1 %}\nspeeds", "loss factor"),
    ],
)
def test_what_has_no_matrices_is_refused(tmp_path: Path, old: str, new: str, words: str) -> None:
    path = tmp_path / "one.yaml"
    path.write_text(CASE.replace(old, new), encoding="utf-8")
    with pytest.raises(InvalidInput, match=words):
        rotordyn.load(path)
