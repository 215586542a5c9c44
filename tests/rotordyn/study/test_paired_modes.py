"""Which mode of the machine a measured one is held against."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rotordyn.study.identification import paired_modes
from rotordyn.study.identification.paired_modes import ALONE, FAR, _merged, assigned
from rotordyn.study.identification.trial import Trial
from tests.rotordyn.study.rotor_twin import case, measured, spindle

MACHINE = 2.0 * np.pi * np.array([819.8, 824.1, 1046.1, 1684.9, 2295.6, 3596.3])


def poles(omega: np.ndarray, damping: float) -> np.ndarray:
    return omega * (1j * np.sqrt(1.0 - damping**2) - damping)


def test_a_measured_mode_too_many_does_not_move_the_others() -> None:
    """Two are resolved where the machine has one; pairs for all would shift every one above."""
    measured = np.array([820.0, 823.0, 1046.0, 1685.0, 2295.4]) * 2.0 * np.pi
    apart = np.abs(np.log(measured[:, None] / MACHINE[1:]))
    rows, columns = assigned(apart / FAR, apart, ALONE)
    assert dict(zip(rows, columns, strict=True)) == {1: 0, 2: 1, 3: 2, 4: 3}
    rows, columns = assigned(apart / FAR, apart)  # where every one is to have a partner
    assert len(rows) == 5


def test_a_mode_far_off_has_no_partner() -> None:
    apart = np.abs(np.log(np.array([[1.5], [1.1]])))
    assert assigned(apart / FAR, apart, ALONE) == ([1], [0])
    assert assigned(apart[:1] / FAR, apart[:1], ALONE) == ([], [])


@pytest.mark.parametrize(("resolved", "left"), [([822.0], 5), ([820.0, 824.0], 6)])
def test_a_whirl_pair_is_one_mode_unless_the_measurement_resolves_it(
    resolved: list[float], left: int
) -> None:
    known = poles(2.0 * np.pi * np.array([*resolved, 1046.0, 1685.0, 2295.0]), 0.006)
    residue = np.ones((6, 1), dtype=complex)
    pole, shape, apart = _merged(poles(MACHINE, 0.006), residue, known)
    assert len(pole) == left
    first = 2.0 * np.pi * 4.3 if left == 5 else 0.0
    np.testing.assert_allclose(apart, [first, *[0.0] * (left - 1)], rtol=1e-3)
    assert shape.sum() == pytest.approx(6.0)


@pytest.mark.parametrize(("share", "joined"), [(0.1, 1), (1e-4, 0)])
def test_a_mode_that_hides_close_to_a_measured_one_is_reported(
    monkeypatch: pytest.MonkeyPatch, share: float, joined: int
) -> None:
    """Three half-widths above it, with a residue of some ``share``; one far below the noise is
    not."""
    real = paired_modes._computed

    def with_another(*asked: Any) -> tuple[np.ndarray, np.ndarray]:
        pole, residue = real(*asked)
        first = np.argmin(np.abs(pole))
        beside = pole[first] - 3.0j * pole[first].real
        return np.append(pole, beside), np.vstack([residue, share * residue[first]])

    monkeypatch.setattr(paired_modes, "_computed", with_another)
    taps = measured(spindle())
    modes = paired_modes.paired_modes(taps, Trial(case(spindle())))
    assert [each.joined for each in modes[:2]] == [bool(joined), False]
    (remark,) = taps.beside(Trial(case(spindle()))).remarks
    assert remark.startswith("several modes of the machine lie where one is measured")
    whirls = ", 357.4 Hz (6685 rpm), 984.0 Hz (6685 rpm)"  # fitted as one, 0.6 and 3.9 Hz apart
    assert remark.endswith(whirls if joined else whirls[2:])
