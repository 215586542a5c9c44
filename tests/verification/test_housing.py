"""Pedestals and housings: closed forms of two masses, dense matrices, reduced models."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import scipy.io
import scipy.linalg

import rotordyn
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.section_forces import solve as section_forces
from rotordyn.analyses.section_forces.spec import SectionForcesSpec
from rotordyn.equation.seat import turn
from rotordyn.equation.support import node_matrix
from rotordyn.errors import InvalidInput
from rotordyn.machine.housing import ReducedHousing, RigidHousing
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.scene import Scene
from tests.oracles.dense_rotor.selection import ALL
from tests.oracles.full_rotor import FullRotor
from tests.oracles.rotors import STEPPED, support
from tests.oracles.spindles import RPM, all_poles, case, mfw2310, pairs, standard

FREQUENCY = tuple(np.linspace(15.0, 900.0, 50))
BODY = rotor_inertia(replace(STEPPED, masses=()))
K, C, MASS = 3e7, 2e3, 9.0


def scene(spindle: Spindle, rpm: tuple[float, ...], **given: object) -> Scene:
    ports = tuple(spindle.points.values())
    return Scene(spindle, Conditions(**given), np.array(rpm) * RPM, 900.0, ports)  # type: ignore[arg-type]


def two(x: float = 0.06) -> tuple[LinearSupport, LinearSupport]:
    """A pair about the centre of gravity."""
    return (
        support("front", BODY.centre - x, (K, 1.5 * K), C),
        support("rear", BODY.centre + x, (K, 1.5 * K), C),
    )


def pedestal(name: str, carries: tuple[str, ...], x: float, **changes: object) -> RigidHousing:
    stiffness = {("y", "y"): 8e7, ("z", "z"): 4e7}
    return replace(
        RigidHousing(name, carries, x, MASS, stiffness, {("y", "y"): 5e2}),
        **changes,  # type: ignore[arg-type]
    )


def swinging(poles: np.ndarray) -> np.ndarray:
    poles = poles[poles.imag > 1e-3]
    return poles[np.argsort(poles.imag)]


def test_two_masses_in_closed_form() -> None:
    """A rigid rotor that moves in parallel, on equal pedestals: m and M in a row, per direction."""
    supports = two()
    own = tuple(pedestal(f"p {s.name}", (s.name,), s.x) for s in supports)
    rotor = replace(STEPPED, masses=(), supports=supports, housings=own)
    found = all_poles(scene(rotor, (0.0,), rotor="rigid"))
    m = BODY.mass / 2.0
    for ground, k, c0 in ((8e7, K, 5e2), (4e7, 1.5 * K, 0.0)):
        polynomial = np.polysub(
            np.polymul([m, C, k], [MASS, C + c0, k + ground]), np.polymul([C, k], [C, k])
        )
        for root in swinging(np.roots(polynomial)):
            assert np.abs(found / root - 1.0).min() < 1e-9


class Dense:
    """All DOF of every node beside those of rigid bodies under some of the connections."""

    def __init__(self, found: Scene, row: int) -> None:
        spindle, mesh = found.spindle, found.mesh
        tangents, speed = found.seat_stiffness[row], found.speed[row]
        bare = FullRotor(spindle, mesh, tangents, speed, ALL)
        n = len(bare.mass)
        size = n + 6 * len(spindle.housings)
        self.mass, self.damping, self.stiffness = (np.zeros((size, size)) for _ in range(3))
        for name in ("mass", "damping", "stiffness"):
            getattr(self, name)[:n, :n] = getattr(bare, name)
        held = [turn(k, s.thrust) for k, s in zip(tangents, spindle.seats, strict=True)]
        held += [node_matrix(s.stiffness) for s in spindle.supports]
        damped = [
            np.diag([s.axial_damping, s.radial_damping, s.radial_damping, 0.0, 0.0, 0.0])
            for s in spindle.seats
        ] + [node_matrix(s.damping) for s in spindle.supports]
        everyone = [*spindle.seats, *spindle.supports]
        for place, housing in enumerate(spindle.housings):
            assert isinstance(housing, RigidHousing)
            own = n + 6 * place + np.arange(6)
            m, p, d = housing.mass, housing.polar_inertia, housing.diametral_inertia
            self.mass[own, own] = [m, m, m, p, d, d]
            self.stiffness[np.ix_(own, own)] += node_matrix(housing.stiffness)
            self.damping[np.ix_(own, own)] += node_matrix(housing.damping)
            for k, each in enumerate(everyone):
                if each.name in housing.carries:
                    at = 6 * mesh.node_of(each.x) + np.arange(6)
                    lever = each.x - housing.x
                    under = np.eye(6)
                    under[1, 5], under[2, 4] = lever, -lever
                    for matrix, block in ((self.stiffness, held[k]), (self.damping, damped[k])):
                        matrix[np.ix_(at, own)] -= block @ under
                        matrix[np.ix_(own, at)] -= under.T @ block
                        matrix[np.ix_(own, own)] += under.T @ block @ under
        stands = [
            n + 6 * place + k
            for place, housing in enumerate(spindle.housings)
            for k, name in enumerate(("x", "y", "z", "thx", "thy", "thz"))
            if name not in housing.dofs  # type: ignore[union-attr]
        ]
        kept = np.setdiff1d(np.arange(size), stands)
        self.rows = {int(row): place for place, row in enumerate(kept)}
        for name in ("mass", "damping", "stiffness"):
            setattr(self, name, getattr(self, name)[np.ix_(kept, kept)])

    def receptance(self, response: int, excitation: int) -> np.ndarray:
        load = np.zeros(len(self.mass))
        load[self.rows[excitation]] = 1.0
        omega = 2.0 * np.pi * np.array(FREQUENCY)
        return np.array(
            [
                np.linalg.solve(self.stiffness + 1j * w * self.damping - w * w * self.mass, load)[
                    self.rows[response]
                ]
                for w in omega
            ]
        )


def against_dense(
    spindle: Spindle, rpm: tuple[float, ...], names: tuple[str, ...], **given: object
) -> None:
    found = scene(spindle, rpm, **given)
    curves = frf.solve(found, FrfSpec(FREQUENCY, pairs(*names))).receptance
    for row in range(len(rpm)):
        dense = Dense(found, row)
        for k, (response, excitation) in enumerate(pairs(*names)):
            places = [
                6 * found.mesh.node_of(spindle.points[port.point])
                + ("x", "y", "z", "thx", "thy", "thz").index(port.direction)
                for port in (response, excitation)
            ]
            exact = dense.receptance(*places)
            scale = max(np.abs(exact).max(), 1e-10)  # zero at rest: rounding
            assert np.abs(curves[row, k] - exact).max() < 2e-5 * scale


def one_housing() -> Spindle:
    """Two supports on one rigid housing that tilts, and moves along the axis."""
    front, rear = two()
    along = {**front.stiffness, ("x", "x"): 5e7, ("thz", "thz"): 3e4, ("y", "z"): 2e6}
    stiffness = {(f, f): 9e7 for f in "xyz"} | {("thy", "thy"): 4e5, ("thz", "thz"): 6e5}
    box = pedestal(
        "box",
        ("front", "rear"),
        BODY.centre + 0.02,
        stiffness=stiffness | {("y", "thz"): 1e6, ("thz", "y"): 1e6},
        damping={("y", "y"): 4e2, ("thy", "thy"): 3.0},
        diametral_inertia=0.08,
    )
    supports = (replace(front, stiffness=along), rear)
    return replace(STEPPED, supports=supports, housings=(box,))


@pytest.mark.parametrize("rpm", [0.0, 12000.0])
def test_the_number_of_modes_is_that_of_all_dof(rpm: float) -> None:
    """Housings under the supports: dense eigenvalues of rotor and housing."""
    found = scene(one_housing(), (rpm,), element_length=0.01)
    highest = 2500.0
    result = campbell.solve(found, CampbellSpec(highest, shapes=False))
    dense = Dense(found, 0)
    n, inverse = len(dense.mass), np.linalg.inv(dense.mass)
    companion = np.block(
        [[np.zeros((n, n)), np.eye(n)], [-inverse @ dense.stiffness, -inverse @ dense.damping]]
    )
    frequency = np.linalg.eigvals(companion).imag / (2.0 * np.pi)
    expected = ((frequency > 1.0) & (frequency <= highest)).sum()
    assert (result.frequency[0] <= highest).sum() == expected > 8


def test_two_supports_on_one_housing() -> None:
    names = ("nose.y/tip.y", "tip.z/tip.y", "nose.x/tip.x", "tip.thz/nose.z")
    against_dense(one_housing(), (0.0, 12000.0), names, element_length=0.01)


def boxed_spindle() -> tuple[Spindle, dict[str, object]]:
    """The flagship, whose bearings stand on one housing, and its conditions."""
    base = mfw2310(rotor_damping=())
    seats = tuple(seat.name for seat in base.seats)
    sleeves = tuple(replace(s, radial_stiffness=np.inf) for s in base.sleeves)
    stiffness = {("y", "y"): 3e8, ("z", "z"): 2e8, ("thy", "thy"): 5e6, ("thz", "thz"): 5e6}
    box = RigidHousing("box", seats, 0.2, 40.0, stiffness, {}, 0.0, 0.9)
    given = {f: getattr(case().conditions, f) for f in ("kinematics", "moment_sharing")}
    spindle = replace(base, sleeves=sleeves, housings=(box,))
    return spindle, {**given, **standard(base), "axial_stiffening": False}


def test_bearings_of_a_spindle_on_one_housing() -> None:
    spindle, given = boxed_spindle()
    names = ("nose_face.y/nose_face.y", "O1.z/nose_face.y")
    against_dense(spindle, (0.0, 24000.0), names, **given)


@pytest.mark.parametrize("rpm", [0.0, 24000.0])
def test_the_number_of_modes_of_a_spindle_without_supports(rpm: float) -> None:
    """Only bearings stand on its housing; the dense eigenvalues are those of bending."""
    spindle, given = boxed_spindle()
    found, highest = scene(spindle, (rpm,), **given), 2500.0
    result = campbell.solve(found, CampbellSpec(highest, shapes=False))
    dense = Dense(found, 0)
    rows = [place for row, place in dense.rows.items() if row % 6 in (1, 2, 4, 5)]
    mass, damping, stiffness = (
        m[np.ix_(rows, rows)] for m in (dense.mass, dense.damping, dense.stiffness)
    )
    n, inverse = len(mass), np.linalg.inv(mass)
    companion = np.block(
        [[np.zeros((n, n)), np.eye(n)], [-inverse @ stiffness, -inverse @ damping]]
    )
    frequency = np.linalg.eigvals(companion).imag / (2.0 * np.pi)
    bent = np.array([kind == "bending" for kind in result.kind])
    expected = ((frequency > 1.0) & (frequency <= highest)).sum()
    assert (result.frequency[0, bent] <= highest).sum() == expected >= 8


def test_a_stiff_housing_is_ground() -> None:
    supports = two()
    stiff = {("y", "y"): 1e13, ("z", "z"): 1e13}
    own = tuple(pedestal(f"under {s.name}", (s.name,), s.x, stiffness=stiff) for s in supports)
    rotor = replace(STEPPED, supports=supports)
    spec = CampbellSpec(max_frequency=900.0)
    ground, housed = (
        campbell.solve(scene(each, (0.0, 12000.0)), spec)
        for each in (rotor, replace(rotor, housings=own))
    )
    assert housed.mode == ground.mode
    assert housed.frequency == pytest.approx(ground.frequency, rel=1e-4)
    assert housed.damping_ratio == pytest.approx(ground.damping_ratio, rel=1e-3, abs=1e-12)


def test_a_housing_that_rolls_alone_leaves_the_rotor_at_rest() -> None:
    """Bearings do not transmit its roll: frequency √(k/I), and a shape of zeros."""
    stiffness = {("y", "y"): 8e7, ("z", "z"): 4e7, ("thx", "thx"): 8e5}
    box = pedestal("box", ("front", "rear"), BODY.centre, stiffness=stiffness, polar_inertia=0.2)
    rotor = replace(STEPPED, supports=two(), housings=(box,))
    result = campbell.solve(scene(rotor, (0.0, 12000.0)), CampbellSpec(max_frequency=900.0))
    twisting = np.flatnonzero(np.array(result.kind) == "torsion")
    alone = np.sqrt(8e5 / 0.2) / (2.0 * np.pi)
    near = np.abs(result.frequency[0, twisting] / alone - 1.0)
    assert near.min() < 1e-9
    assert not result.shape[:, twisting[near.argmin()]].any()


def reduced(spindle: Spindle, *, modal: bool) -> ReducedHousing:
    """The rigid housing of ``one_housing`` as matrices, or as its undamped modes."""
    (box,) = spindle.housings
    assert isinstance(box, RigidHousing)
    stations = {each.name: each.x - box.x for each in spindle.supports}
    freedoms = ("x", "y", "z", "thy", "thz")
    places, rows = [], []
    for name in box.carries:
        for direction, lever in (
            ("x", None),
            ("y", "thz"),
            ("z", "thy"),
            ("thy", None),
            ("thz", None),
        ):
            row = np.array([float(f == direction) for f in freedoms])
            if lever:
                row[freedoms.index(lever)] = stations[name] * (1.0 if lever == "thz" else -1.0)
            places.append(f"{name}.{direction}")
            rows.append(row)
    kept = [0, 1, 2, 4, 5]
    mass = np.diag([MASS, MASS, MASS, 0.08, 0.08])
    stiffness = node_matrix(box.stiffness)[np.ix_(kept, kept)]
    damping = node_matrix(box.damping)[np.ix_(kept, kept)]
    shape = np.array(rows)
    if modal:
        scale = np.diag(np.diag(mass) ** -0.5)
        values, vectors = np.linalg.eigh(scale @ stiffness @ scale)
        vectors = scale @ vectors
        mass, stiffness = np.eye(5), np.diag(values)
        damping, shape = vectors.T @ damping @ vectors, shape @ vectors
    return ReducedHousing(
        "box", box.carries, tuple(places), *map(_rows, (shape, mass, stiffness, damping))
    )


def _rows(matrix: np.ndarray) -> tuple[tuple[float, ...], ...]:
    return tuple(tuple(map(float, row)) for row in matrix)


@pytest.mark.parametrize("modal", [False, True], ids=["matrices", "modes"])
def test_a_reduced_model_is_the_body_it_was_made_from(modal: bool) -> None:
    rotor = one_housing()
    model = replace(rotor, housings=(reduced(rotor, modal=modal),))
    ours, theirs = (scene(each, (0.0, 12000.0)) for each in (model, rotor))
    for row in (0, 1):
        a, b = (swinging(all_poles(each, row)) for each in (ours, theirs))
        assert len(a) == len(b)
        assert np.abs(a / b - 1.0).max() < 1e-7


def test_the_error_of_a_coarse_mesh_is_estimated() -> None:
    """Two standard elements: the estimate is of the size of the error."""
    spec = CampbellSpec(max_frequency=800.0)
    coarse, fine = (
        campbell.solve(scene(one_housing(), (6000.0,), **given), spec)
        for given in ({"element_length": 0.2}, {"accuracy": 1e-7})
    )
    bent = [k for k, kind in enumerate(coarse.kind) if kind == "bending"][-2:]
    error = np.abs(coarse.frequency / fine.frequency - 1.0)[0, bent]
    assert error.max() > 1e-4
    assert coarse.frequency_error[0, bent] == pytest.approx(error, rel=0.3)


def test_springs_in_series_at_rest() -> None:
    front, rear = two()
    hold = {("x", "x"): 1e7, ("thx", "thx"): 1e3}
    front = replace(front, stiffness={**front.stiffness, **hold})
    own = pedestal("p", ("front",), front.x)
    rotor = replace(STEPPED, supports=(front, rear), housings=(own,))
    loads = SectionForcesSpec(loads=(PointLoad(at=front.x, Fy=100.0, Fz=40.0),))
    found = section_forces.solve(scene(rotor, (0.0,)), loads)
    place = np.flatnonzero(np.isclose(found.cut, front.x))[0]
    assert found.deflection_y[0, place] == pytest.approx(100.0 * (1 / K + 1 / 8e7), rel=1e-9)
    assert found.deflection_z[0, place] == pytest.approx(40.0 * (1 / (1.5 * K) + 1 / 4e7), rel=1e-9)


@pytest.mark.parametrize(
    ("housings", "words"),
    [
        ((pedestal("p", ("fronn",), 0.0),), r"unknown support .* 'fronn'.*did you mean front"),
        (
            (pedestal("p", ("front",), 0.0), pedestal("q", ("front",), 0.0)),
            "is on two housings",
        ),
    ],
)
def test_housings_carry_what_there_is(housings: tuple[RigidHousing, ...], words: str) -> None:
    with pytest.raises(InvalidInput, match=words):
        replace(STEPPED, supports=two(), housings=housings)


def test_bodies_without_mass_are_refused() -> None:
    with pytest.raises(InvalidInput, match="needs mass: given 0"):
        pedestal("p", ("front",), 0.0, mass=0.0)
    with pytest.raises(InvalidInput, match="thy needs diametral_inertia"):
        pedestal("p", ("front",), 0.0, stiffness={("thy", "thy"): 1.0}, damping={})


CASE = """
title: rotor on a housing
spindle:
  shaft:
    start: 0 mm
    material: steel_rotor
    sections: [{length: 0.4 m, outer_diameter: 50 mm}]
  supports:
    - {name: front, x: 50 mm, stiffness: {yy: 30 N/um, zz: 30 N/um}}
    - {name: rear, x: 350 mm, stiffness: {yy: 30 N/um, zz: 30 N/um}}
  housings: %s
speeds: [0 rpm, 6000 rpm]
analyses: {campbell: {max_frequency: 800 Hz}}
"""
PLACES = ["front.y", "rear.y", "front.z", ""]
MATRIX = np.diag([8.0, 9.0, 7.0, 2.0])
STIFFNESS = 1e7 * np.array([[9.0, 2, 1, 1], [2, 8, 0, 1], [1, 0, 6, 1], [1, 1, 1, 5]])


def solve(folder: Path, housings: str) -> tuple[np.ndarray, object]:
    (folder / "case.yaml").write_text(CASE % housings)
    made = rotordyn.load(folder / "case.yaml")
    return rotordyn.run(made)["campbell"].frequency.values, made


def test_all_files_of_a_model_say_the_same(tmp_path: Path) -> None:
    damping = 1e-5 * STIFFNESS
    values, vectors = scipy.linalg.eigh(STIFFNESS, MATRIX)
    omega = np.sqrt(values)
    np.savez(
        tmp_path / "matrices.npz", places=PLACES, mass=MATRIX, stiffness=STIFFNESS, damping=damping
    )
    np.savez(
        tmp_path / "modes.npz",
        places=PLACES[:3],
        frequency=omega / (2 * np.pi),
        damping_ratio=1e-5 * omega / 2.0,
        shape=vectors[:3],
    )
    for name, matrix in (("M", MATRIX), ("K", STIFFNESS), ("C", damping)):
        scipy.io.mmwrite(tmp_path / f"{name}.mtx", matrix)
    files = "mass: M.mtx, stiffness: K.mtx, damping: C.mtx"
    market = f"{{{files}, places: [front.y, rear.y, front.z, '']}}"
    found = [
        solve(tmp_path, f"[{{name: box, carries: [front, rear], model: {model}}}]")[0]
        for model in ("matrices.npz", "modes.npz", market)
    ]
    assert found[1] == pytest.approx(found[0], rel=1e-8)
    assert found[2] == pytest.approx(found[0], rel=1e-12)
    held = CASE % "[{name: box, carries: [front, rear], model: matrices.npz}]"
    (tmp_path / "compared.yaml").write_text(f"{held}compare: {{one: {{}}, other: {{}}}}\n")
    (housing,) = rotordyn.load(tmp_path / "compared.yaml").variants["other"].spindle.housings
    assert np.array(housing.mass) == pytest.approx(MATRIX)


def test_a_rigid_housing_in_a_case(tmp_path: Path) -> None:
    text = (
        "[{name: box, carries: [front, rear], x: 200 mm, mass: 20 kg,"
        " diametral_inertia: 0.4 kg m^2, damping: {yy: 100 N s/m},"
        " stiffness: {yy: 90 N/um, zz: 60 N/um, thz_thz: 2 MN m/rad}}]"
    )
    frequency, made = solve(tmp_path, text)
    (box,) = made.spindle.housings  # type: ignore[attr-defined]
    assert isinstance(box, RigidHousing)
    assert box.dofs == ("y", "z", "thz")
    assert (box.mass, box.x, box.diametral_inertia) == (20.0, 0.2, 0.4)
    assert np.isfinite(frequency).all()


PLAIN: dict[str, object] = {"places": PLACES, "mass": MATRIX, "stiffness": STIFFNESS}
MODAL: dict[str, object] = {
    "places": ["front.y", "rear.y"],
    "frequency": [50.0],
    "damping_ratio": [0.02],
    "shape": [[1.0], [0.5]],
}


@pytest.mark.parametrize(
    ("held", "words"),
    [
        ({"mass": MATRIX, "stiffness": STIFFNESS}, "lacks places: given mass, stiffness"),
        ({"places": PLACES, "mass": MATRIX}, "lacks stiffness: given places, mass"),
        ({"places": PLACES, "frequency": [1.0]}, "lacks damping_ratio"),
        ({"places": PLACES, "mass": MATRIX, "stiffness": np.eye(3)}, "given 3 × 3; allowed: 4 × 4"),
        ({"places": PLACES, "mass": 0 * MATRIX, "stiffness": STIFFNESS}, "not positive definite"),
        ({"places": PLACES, "mass": MATRIX + np.inf, "stiffness": STIFFNESS}, "not a finite real"),
        ({"places": ["front.y"], "mass": [[1.0]], "stiffness": [[1.0]]}, "no place under 'rear'"),
        (
            {"places": ["front.y", "rera.y"], "mass": np.eye(2), "stiffness": np.eye(2)},
            "unknown place 'rera.y'",
        ),
        (
            {**PLAIN, "dampening": STIFFNESS},
            "unknown array: given 'dampening'; allowed: places, .*did you mean damping",
        ),
        (
            {**PLAIN, "frequency": [50.0]},
            "both matrices and modes: given mass, stiffness and frequency; allowed: places with",
        ),
        (
            {**MODAL, "damping_ratio": [5.0]},
            "damping_ratio: ratio out of range: given 5; allowed: from 0 % below 100 %",
        ),
        ({**MODAL, "frequency": [-5.0]}, "frequency below zero: given -5 Hz; allowed: from 0 Hz"),
    ],
)
def test_broken_models_say_why(tmp_path: Path, held: dict[str, object], words: str) -> None:
    np.savez(tmp_path / "box.npz", **held)  # type: ignore[arg-type]
    with pytest.raises(InvalidInput, match=words) as caught:
        solve(tmp_path, "[{name: box, carries: [front, rear], model: box.npz}]")
    assert all(fault.line == 11 for fault in caught.value.faults)


def test_files_that_are_no_models(tmp_path: Path) -> None:
    for text in ("nonsense", ""):
        (tmp_path / "box.npz").write_text(text)
        with pytest.raises(InvalidInput, match="is not a numpy archive"):
            solve(tmp_path, "[{name: box, carries: [front, rear], model: box.npz}]")
    (tmp_path / "M.mtx").write_text("nonsense")
    model = "{mass: M.mtx, stiffness: M.mtx, places: [front.y, rear.y]}"
    with pytest.raises(InvalidInput, match="mass is not a Matrix Market file"):
        solve(tmp_path, f"[{{name: box, carries: [front, rear], model: {model}}}]")
