"""The reduced bending system against all DOF of the same rotor, solved densely."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from rotordyn.analyses.frf import solve as frf
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.scene import Scene
from tests.oracles.full_rotor import FullRotor
from tests.oracles.spindles import case, mfw2310, pairs, scene, system_of, with_sleeve

PORTS = (-0.0524, -0.0721)
PAIRS = (
    "Oc2.y/Oc2.y",
    "Oc2.z/Oc2.y",
    "Oc1.y/Oc2.y",
    "Oc2.thz/Oc2.y",
    "Oc2.y/Oc2.z",
    "Oc2.thy/Oc2.thz",
    "Oc2.thy/Oc2.y",
    "Oc2.z/Oc2.thy",
)
FREQUENCY = np.linspace(5.0, 4000.0, 120)
UNDAMPED_ROTOR = mfw2310(rotor_damping=())


@cache
def solved(damping: tuple[float, ...] = ()) -> Scene:
    return scene(mfw2310(rotor_damping=damping), (0, 24000), ports=PORTS)


def full(found: Scene, row: int) -> FullRotor:
    force = found.bending_force()
    return FullRotor(
        found.spindle,
        found.mesh,
        found.seat_stiffness[row],
        found.speed[row],
        axial_force=None if force is None else force[row],
    )


def poles(found: Scene, row: int, highest: float) -> np.ndarray:
    """Poles of the reduced system in the upper half plane."""
    values = system_of(found).modes.pole[row]
    if system_of(found).whirling:
        values = np.where(values.imag > 0, values, values.conj())
    values = values[(values.imag > 1.0) & (values.imag < 2 * np.pi * highest)]
    return values[np.argsort(values.imag)]


def curves(found: Scene, names: tuple[str, ...] = PAIRS) -> Any:
    spec = FrfSpec(tuple(FREQUENCY), pairs(*names))
    return frf.solve(found, spec).receptance


def dense(found: Scene, row: int, names: tuple[str, ...] = PAIRS) -> np.ndarray:
    rotor, points = full(found, row), found.spindle.points
    ends = [
        tuple(rotor.row(points[port.point], port.direction) for port in pair)
        for pair in pairs(*names)
    ]
    return rotor.receptance(ends, FREQUENCY)  # type: ignore[arg-type]


def gap(ours: np.ndarray, exact: np.ndarray) -> float:
    """Largest difference over the peak, worst pair; pairs that must be zero over the others'."""
    peak = np.abs(exact).max(axis=-1)
    floor = np.where(peak > 1e-9 * peak.max(), peak, peak.max())
    return float((np.abs(ours - exact).max(axis=-1) / floor).max())


@pytest.mark.parametrize("row", [0, 1], ids=["rest", "24000 rpm"])
def test_poles_below_4_khz(row: int) -> None:
    """Eigenvalues to 1e-6 at rest; at speed the gyroscopic effect couples modes kept to those cut
    off at four times the band, 1e-5, a tenth of the accuracy requested."""
    ours, exact = poles(solved(), row, 4000.0), full(solved(), row).poles(4000.0)
    assert len(ours) == len(exact) >= 8
    assert np.abs(ours / exact - 1.0).max() < (1e-6, 1e-5)[row]


@pytest.mark.parametrize("row", [0, 1], ids=["rest", "24000 rpm"])
def test_receptance_without_rotor_damping(row: int) -> None:
    # of peaks of a damping ratio ζ, δ/2ζ by the error δ of their pole
    assert gap(curves(solved())[row], dense(solved(), row)) < (1e-5, 5e-3)[row]


@pytest.mark.parametrize("row", [0, 1], ids=["rest", "24000 rpm"])
def test_receptance_with_modal_damping(row: int) -> None:
    """Modes far above the band are damped as one group: 1e-4 of the peak."""
    found = solved((0.01, 0.02, 0.05))
    ours, exact = poles(found, row, 4000.0), full(found, row).poles(4000.0)
    assert np.abs(ours / exact - 1.0).max() < 1e-5
    assert gap(curves(found)[row], dense(found, row)) < 1e-4


def test_complex_and_real_form_agree() -> None:
    """The same rotor in both forms; one tangent 1e-8 stiffer in z asks for the real one."""
    ours = solved((0.01, 0.02, 0.05))
    tangents = ours.seat_stiffness.copy()
    tangents[:, 0, 2, 2] *= 1.0 + 1e-8
    uneven = scene(ours.spindle, (0, 24000), ports=PORTS)
    uneven.solved["preload"] = _Tangents(ours, tangents)
    assert system_of(ours).whirling
    assert not system_of(uneven).whirling
    assert curves(uneven) == pytest.approx(curves(ours), rel=1e-5, abs=1e-13)
    for row in (0, 1):
        a, b = poles(ours, row, 4000.0), poles(uneven, row, 4000.0)
        assert b == pytest.approx(a, rel=1e-7)


class _Tangents:
    """A preload state with other bearing tangents."""

    def __init__(self, ours: Scene, tangents: np.ndarray) -> None:
        self.outcome, self._tangents = ours.preload.outcome, tangents
        self.seat_load, self.stopped = ours.preload.seat_load, ours.preload.stopped

    def seat_stiffness(self, tangent: str = "complete") -> np.ndarray:
        return self._tangents


def test_anisotropic_supports_against_all_dof() -> None:
    """Lalanne and Ferraris' rotor at 30 000 rpm, receptance with both planes coupled."""
    rotor = case("lalanne_ferraris")
    found = Scene(
        rotor.spindle, rotor.conditions, np.array(rotor.speeds)[[0, -1]], 600.0, (0.2, 0.5)
    )
    assert not system_of(found).whirling
    names = ("disc_1.y/disc_2.y", "disc_1.z/disc_2.y", "disc_2.thy/disc_1.z")
    global_frequency = np.linspace(5.0, 590.0, 150)
    spec = FrfSpec(tuple(global_frequency), pairs(*names))
    ours = frf.solve(found, spec).receptance
    for row in (0, 1):
        assert poles(found, row, 600.0) == pytest.approx(full(found, row).poles(600.0), rel=1e-5)
        rotor_all = full(found, row)
        ends = [
            tuple(rotor_all.row(found.spindle.points[p.point], p.direction) for p in pair)
            for pair in pairs(*names)
        ]
        exact = rotor_all.receptance(ends, global_frequency)  # type: ignore[arg-type]
        assert gap(ours[row], exact) < 1e-3


def test_eigenpairs_leave_no_residual() -> None:
    for found in (solved(), solved((0.01, 0.02, 0.05))):
        assert system_of(found).residual < 1e-10


def test_static_limit_is_the_flexibility() -> None:
    """H at 2 Hz against K⁻¹ of all DOF."""
    found = solved()
    spec = FrfSpec((1e-2,), pairs("Oc2.y/Oc2.y", "Oc1.y/Oc2.y", "Oc2.thz/Oc2.thz"))
    ours = frf.solve(found, spec).receptance[..., 0]
    for row in (0, 1):
        rotor = full(found, row)
        flexibility = np.linalg.inv(rotor.stiffness)
        y2, y1 = rotor.row(-0.0524, "y"), rotor.row(-0.0721, "y")
        t2 = rotor.row(-0.0524, "thz")
        expected = [flexibility[y2, y2], flexibility[y1, y2], flexibility[t2, t2]]
        assert ours[row].real == pytest.approx(expected, rel=1e-6)
        assert np.abs(ours[row].imag).max() < 1e-4 * np.abs(expected).max()


def test_reciprocity_at_rest() -> None:
    """K is symmetric at rest: response and excitation may change places."""
    there = curves(solved(), ("Oc1.y/Oc2.y", "Oc2.thz/Oc2.y", "O1.y/Oc2.thz"))[0]
    back = curves(solved(), ("Oc2.y/Oc1.y", "Oc2.y/Oc2.thz", "Oc2.thz/O1.y"))[0]
    assert gap(there, back) < 1e-9


def test_planes_change_sign_with_the_cross_path() -> None:
    """Isotropy: zz = yy, yz = −zy; tilt about y answers a force z as tilt −z answers y."""
    h = curves(solved(), ("Oc2.y/Oc2.y", "Oc2.z/Oc2.z", "Oc2.z/Oc2.y", "Oc2.y/Oc2.z"))[1]
    assert h[1] == pytest.approx(h[0], rel=1e-9)
    assert h[3] == pytest.approx(-h[2], rel=1e-9)
    t = curves(solved(), ("Oc2.thz/Oc2.y", "Oc2.thy/Oc2.z"))[1]
    assert t[1] == pytest.approx(-t[0], rel=1e-9)


def test_opposite_spin_transposes_the_receptance() -> None:
    """With symmetric bearings H(−Ω) = H(Ω)ᵀ; with those of a spinning bearing nearly."""
    found = scene(UNDAMPED_ROTOR, (0, 24000), ports=PORTS, bearings="static")
    reversed_ = Scene(UNDAMPED_ROTOR, found.conditions, -found.speed, 4000.0, PORTS)
    a = curves(found, ("Oc1.y/Oc2.y", "Oc2.z/Oc2.y"))[1]
    b = curves(reversed_, ("Oc2.y/Oc1.y", "Oc2.y/Oc2.z"))[1]
    assert gap(a, b) < 1e-8


def test_sprung_sleeve_stiff_in_radial_direction_is_no_sleeve() -> None:
    """Frequencies approach those of a rigidly held sleeve with 1/stiffness."""
    limit = poles(scene(mfw2310(), (0,)), 0, 3000.0)
    gaps = []
    for stiffness in (1e10, 1e11, 1e12):
        spindle = with_sleeve(mfw2310(), "rear", radial_stiffness=stiffness)
        found = poles(scene(spindle, (0,)), 0, 3000.0)
        gaps.append(np.abs(found / limit - 1.0).max())
    assert gaps[0] / gaps[1] == pytest.approx(10.0, rel=0.2)
    assert gaps[2] < 1e-4


def test_sprung_sleeve_is_in_series_with_its_bearings() -> None:
    """Massless sleeve: bearings d, e act against a common ring held by 3e8 N/m."""
    spindle = with_sleeve(UNDAMPED_ROTOR, "rear", radial_stiffness=3e8)
    bare = tuple(replace(s, radial_damping=0.0) for s in spindle.seats)
    spindle = replace(spindle, seats=bare)
    found = scene(spindle, (0,))
    rotor = full(found, 0)
    rows = [rotor.row(s.x, f) for s in spindle.seats[3:] for f in ("y", "z")]
    tangents = found.seat_stiffness[0, 3:]
    stiffness = np.pad(rotor.stiffness, (0, 2))
    for place, plane in ((-2, 0), (-1, 1)):
        for k, seat in enumerate(spindle.seats[3:]):
            y = rows[2 * k + plane]
            tilt = rotor.row(seat.x, "thz" if plane == 0 else "thy")
            sign = -1.0 if plane == 0 else 1.0
            direct, cross = tangents[k][1, 1], sign * seat.thrust * tangents[k][2, 3]
            stiffness[place, place] += direct
            stiffness[place, y] -= direct
            stiffness[y, place] -= direct
            stiffness[place, tilt] -= cross
            stiffness[tilt, place] -= cross
        stiffness[place, place] += 3e8
    held, free = slice(-2, None), slice(None, -2)
    inner = np.linalg.solve(stiffness[held, held], stiffness[held, free])
    rotor.stiffness = stiffness[free, free] - stiffness[free, held] @ inner
    assert poles(found, 0, 3000.0) == pytest.approx(rotor.poles(3000.0), rel=2e-3)
    rigid = poles(scene(replace(spindle, sleeves=UNDAMPED_ROTOR.sleeves), (0,)), 0, 3000.0)
    assert np.abs(poles(found, 0, 3000.0) / rigid - 1.0).max() > 0.02


def test_heavier_sleeve_lowers_the_frequencies() -> None:
    light, heavy = (
        poles(scene(with_sleeve(_undamped(), "rear", radial_stiffness=3e8, mass=m), (0,)), 0, 3e3)
        for m in (1.0, 8.0)
    )
    count = min(len(light), len(heavy), 6)
    assert (heavy.imag[:count] < light.imag[:count] + 1e-6).all()
    assert heavy.imag[:count].sum() < 0.999 * light.imag[:count].sum()


def _undamped() -> Spindle:
    seats = tuple(replace(s, radial_damping=0.0) for s in UNDAMPED_ROTOR.seats)
    return replace(UNDAMPED_ROTOR, seats=seats)
