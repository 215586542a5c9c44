"""The simply supported spinning Timoshenko beam against its closed form: values and rates."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from rotordyn.equation.mesh import build_mesh
from tests.oracles.case_files import answered, bending_poles
from tests.oracles.dense_rotor.assemble import bending_plane
from tests.oracles.dense_rotor.selection import PLANE_Y
from tests.oracles.rotors import uniform
from tests.oracles.spinning_beam import PinnedBeam
from tests.oracles.whirl import frequencies_at_rest, whirl_frequencies

SLENDER, STUBBY = PinnedBeam(1.0, 0.05), PinnedBeam(0.5, 0.10)
AT_REST = {
    SLENDER: [638.2053, 2530.1689, 5611.5513, 9785.9184, 14937.2511, 20942.1216],
    STUBBY: [4892.9592, 17518.1838, 34422.4582, 53347.7719, 73167.5698, 93348.3034],
}
BACKWARD = {
    SLENDER: [635.1606, 2518.3601, 5586.2691, 9743.8486, 14876.5650, 20862.3281],
    STUBBY: [4850.9556, 17402.6185, 34256.8741, 53161.3169, 72979.4686, 93168.8843],
}
FORWARD = {
    SLENDER: [641.2644, 2542.0290, 5636.9298, 9828.1193, 14998.0796, 21022.0379],
    STUBBY: [4935.2251, 17633.7396, 34587.1753, 53532.6126, 73353.6433, 93525.5654],
}
BEAMS = pytest.mark.parametrize("beam", [SLENDER, STUBBY], ids=["slender", "stubby"])


def pinned(beam: PinnedBeam, elements: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(mass, polar, stiffness) without the deflection of the two ends."""
    spindle = uniform(beam.length, beam.diameter)
    mesh = build_mesh(spindle, beam.length / elements)
    plane = bending_plane(spindle, mesh)
    held = [PLANE_Y.row(0, "y"), PLANE_Y.row(mesh.nodes - 1, "y")]
    free = np.setdiff1d(np.arange(PLANE_Y.size(mesh.nodes)), held)
    return tuple(m[np.ix_(free, free)] for m in (plane.mass, plane.polar, plane.stiffness))


def computed(beam: PinnedBeam, elements: int, spin: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """(backward, forward) frequencies, ascending [rad/s]."""
    mass, polar, stiffness = pinned(beam, elements)
    if spin == 0.0:
        found = frequencies_at_rest(mass, stiffness)
        return found, found
    found = whirl_frequencies(mass, polar, stiffness, spin)
    return -found[found < 0], found[found > 0]


def exact(beam: PinnedBeam, spin: float, modes: int = 6) -> tuple[np.ndarray, np.ndarray]:
    pairs = np.array([beam.bending_whirl(n, spin) for n in range(1, modes + 1)])
    return pairs[:, 0], pairs[:, 1]


@BEAMS
def test_closed_form_meets_the_table(beam: PinnedBeam) -> None:
    assert exact(beam, 0.0)[1] == pytest.approx(AT_REST[beam], abs=6e-5)
    assert exact(beam, 2000.0)[0] == pytest.approx(BACKWARD[beam], abs=6e-5)
    assert exact(beam, 2000.0)[1] == pytest.approx(FORWARD[beam], abs=6e-5)


def test_closed_form_second_spectrum() -> None:
    assert SLENDER.frequencies(1, 0.0)[3] == pytest.approx(243099.0703, abs=6e-5)
    expected = [-241110.3742, 245104.2703]
    assert SLENDER.frequencies(1, 2000.0)[[0, 3]] == pytest.approx(expected, abs=6e-5)
    assert STUBBY.frequencies(1, 0.0)[3] == pytest.approx(126832.9599, abs=6e-5)
    expected = [-124891.5078, 128807.2382]
    assert STUBBY.frequencies(1, 2000.0)[[0, 3]] == pytest.approx(expected, abs=6e-5)


@pytest.mark.parametrize(
    ("beam", "elements", "percent"),
    [
        (SLENDER, 4, ["0.0372", "0.557", "2.52", "14.7", "17.6"]),
        (SLENDER, 8, ["0.0045", "0.0699", "0.337", "0.998", "2.25", "4.22"]),
        (SLENDER, 16, ["0.00082", "0.0129", "0.0628", "0.189", "0.435", "0.844"]),
        (SLENDER, 32, ["0.00019", "0.0029", "0.0143", "0.0432", "0.0999", "0.195"]),
        (STUBBY, 4, ["0.189", "2.30", "8.23"]),
        (STUBBY, 8, ["0.0432", "0.537", "2.03", "4.79", "8.82", "13.5"]),
        (STUBBY, 16, ["0.0105", "0.132", "0.499", "1.19", "2.24", "3.65"]),
        (STUBBY, 32, ["0.0026", "0.0327", "0.124", "0.296", "0.557", "0.910"]),
    ],
)
def test_error_table_of_the_standard_element(
    beam: PinnedBeam, elements: int, percent: list[str]
) -> None:
    """To the last digit printed (some rows are cut there, others rounded)."""
    found = computed(beam, elements)[1][: len(percent)]
    error = 100 * (found / exact(beam, 0.0, len(percent))[1] - 1)
    last_place = np.array([10.0 ** -len(p.split(".")[1]) for p in percent])
    assert (np.abs(error - np.array(percent, dtype=float)) <= 0.75 * last_place).all()


@BEAMS
@pytest.mark.parametrize("spin", [0.0, 2000.0, -2000.0])
def test_order_two(beam: PinnedBeam, spin: float) -> None:
    """Halving the element divides the error by four, forward and backward."""
    for whirl in (0, 1):
        target = exact(beam, spin, 4)[whirl]
        errors = [computed(beam, n, spin)[whirl][:4] / target - 1 for n in (64, 128)]
        assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.06)


@pytest.mark.parametrize("ratio", [0.05, 0.5, 2.0, 5.0, 20.0, 100.0])
@pytest.mark.parametrize("spin_over_frequency", [0.0, 0.5])
def test_error_is_what_the_derivation_says(ratio: float, spin_over_frequency: float) -> None:
    """s (k h)²/24 and its bending companion, from a disc to a wire, spinning or not."""
    beam, elements = PinnedBeam(0.5, 0.5 / ratio), 24
    spin = spin_over_frequency * beam.bending_whirl(1, 0.0)[1]
    backward, forward = computed(beam, elements, spin)
    for mode in (1, 2):
        signed = zip((-1, 1), (backward, forward), beam.bending_whirl(mode, spin), strict=True)
        for sign, found, target in signed:
            predicted = beam.element_error(mode, spin, sign * target, beam.length / elements)
            nearest = found[np.abs(found - target * (1 + predicted)).argmin()]
            assert nearest / target - 1 == pytest.approx(predicted, rel=0.02)


@pytest.mark.parametrize(("ratio", "rel"), [(20.0, 2e-3), (5.0, 0.01)], ids=["slender", "stubby"])
def test_shear_share_governs_at_rest(ratio: float, rel: float) -> None:
    """s (k h)²/24 + (1 − s) (k h)⁴/1440, where rotary inertia is small."""
    beam, elements = PinnedBeam(0.5, 0.5 / ratio), 32
    k, h, omega = beam.wave_number(1), beam.length / elements, beam.bending_whirl(1, 0.0)[1]
    slope = beam.shear * k**2 - beam.line_mass * omega**2
    shear = beam.shear * (beam.shear * k**2 - slope) ** 2
    share = shear / (shear + beam.bending * (k * slope) ** 2)
    expected = share * (k * h) ** 2 / 24 + (1 - share) * (k * h) ** 4 / 1440
    assert computed(beam, elements)[1][0] / omega - 1 == pytest.approx(expected, rel=rel)


@pytest.mark.parametrize("beam", [STUBBY, PinnedBeam(0.2, 0.2)], ids=["stubby", "square"])
def test_second_spectrum(beam: PinnedBeam) -> None:
    """Forward and backward, among the higher modes of the same matrices, error as derived."""
    elements, spin = 96, 2000.0
    roots = beam.frequencies(1, spin)[[0, 3]]
    for found, target in zip(computed(beam, elements, spin), roots, strict=True):
        predicted = beam.element_error(1, spin, target, beam.length / elements)
        error = found / abs(target) - 1
        assert error[np.abs(error - predicted).argmin()] == pytest.approx(predicted, rel=0.02)


def test_no_spin_softening_in_the_inertial_frame() -> None:
    """Subtracting Ω² M_ω in the fixed frame would miss the exact whirl by a wide margin."""
    spindle = uniform(SLENDER.length, SLENDER.diameter)
    plane = bending_plane(spindle, build_mesh(spindle, SLENDER.length / 32))
    size = len(plane.mass)
    free = np.setdiff1d(np.arange(size), [0, size - 2])
    inner = np.ix_(free, free)
    softened = plane.stiffness[inner] - 500.0**2 * plane.translational_mass[inner]
    found = whirl_frequencies(plane.mass[inner], plane.polar[inner], softened, 500.0)
    assert abs(found[0] / SLENDER.bending_whirl(1, 500.0)[0]) < 0.7


PINNED = """
spindle:
  shaft:
    start: 0 mm
    material: {{name: steel, young_modulus: 210 GPa, poisson_ratio: 0.3, density: 7800 kg/m^3}}
    sections: [{{length: {length} m, outer_diameter: {diameter} m}}]
  supports:
    - {{name: left, x: 0 m, stiffness: &pin {{yy: {pin} N/um, zz: {pin} N/um}}}}
    - {{name: right, x: {length} m, stiffness: *pin}}
conditions: {{accuracy: 1e-8}}
speeds: [0 rad/s, 2000 rad/s]
analyses: {{campbell: {{max_frequency: {highest} Hz, shapes: false}}}}
"""


@BEAMS
def test_the_table_from_a_case_file(beam: PinnedBeam, tmp_path: Path) -> None:
    """Pins of 1e12 N/m, a half and a quarter of it, led to no compliance."""
    highest = 1.01 * FORWARD[beam][-1] / (2.0 * np.pi)
    shape = {"length": beam.length, "diameter": beam.diameter, "highest": highest}
    hard, half, quarter = (
        answered(PINNED.format(pin=pin, **shape), tmp_path)["campbell"]
        for pin in ("1e6", "5e5", "2.5e5")
    )
    twice = np.repeat(AT_REST[beam], 2)
    pairs = np.stack([BACKWARD[beam], FORWARD[beam]], axis=1).ravel()
    for row, expected in enumerate((twice, pairs)):
        found = [bending_poles(modes, row).imag[:12] for modes in (hard, half, quarter)]
        stiff = (8.0 * found[0] - 6.0 * found[1] + found[2]) / 3.0
        assert stiff == pytest.approx(np.sort(expected), rel=1e-6)
