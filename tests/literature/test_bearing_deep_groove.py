"""A deep-groove bearing without clearance, static: a commercial code after ISO/TS 16281.

Z 7, Dw 11.5 mm, Dpw 43.5 mm, grooves 0.52 and 0.53 Dw, E 210 GPa, ν 0.3. Tolerance 0.5 %: that
code uses the approximate contact constants of the standard.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

from bearings.geometry import geometry
from tests.oracles.known_bearings import ISO_DEEP_GROOVE


def test_radial_load() -> None:
    """1000 N towards a ball; the reference forces the tilt to zero only by symmetry."""
    s = ISO_DEEP_GROOVE.equilibrium(load=[0.0, 1000.0, 0.0, 0.0, 0.0])
    assert s.displacement[1] * 1e6 == pytest.approx(15.1101, rel=5e-3)
    assert s.displacement[[0, 2, 3, 4]] == pytest.approx(0.0, abs=1e-12)
    assert np.count_nonzero(s.inner_load > 0.0) == 3


def test_axial_load() -> None:
    s = ISO_DEEP_GROOVE.equilibrium(load=[1000.0, 0.0, 0.0, 0.0, 0.0])
    assert s.displacement[0] * 1e6 == pytest.approx(133.5381, rel=5e-3)
    assert np.ptp(s.inner_load) == pytest.approx(0.0, abs=1e-9)


def tilt_of_a_moment(arm: float) -> float:
    """Tilt under 1 N·m of balls whose groove centres lie on the radius ``arm`` [m], a plain sum."""
    b, g = ISO_DEEP_GROOVE, geometry(ISO_DEEP_GROOVE.grooves)
    stiffness = (g.inner.stiffness ** (-2 / 3) + g.outer.stiffness ** (-2 / 3)) ** -1.5
    free = (b.inner_conformity + b.outer_conformity - 1.0) * b.ball_diameter
    sine = np.sin(2.0 * np.pi * np.arange(b.balls) / b.balls)

    def moment(tilt: float) -> float:
        aside = tilt * arm * sine
        length = np.hypot(free, aside)
        return float((stiffness * (length - free) ** 1.5 * aside / length * arm * sine).sum())

    return float(brentq(lambda tilt: moment(tilt) - 1.0, 1e-4, 1e-2))


def test_pure_moment() -> None:
    """That code's 3.6957 mrad has the arm dm/2; the inner groove's centre lies 1.06 % further out,
    which makes the tilt smaller by its power 5/4."""
    b, held = ISO_DEEP_GROOVE, [0.0, 0.0, 0.0, 0.0, np.nan]
    s = b.equilibrium(load=[*[np.nan] * 4, 1.0], displacement=held)
    radius = b.pitch_diameter / 2.0
    centre = radius + (b.inner_conformity - 0.5) * b.ball_diameter
    assert tilt_of_a_moment(radius) * 1e3 == pytest.approx(3.6957, rel=1e-3)
    assert s.displacement[4] == pytest.approx(tilt_of_a_moment(centre), rel=1e-3)
    assert s.displacement[4] * 1e3 == pytest.approx(3.6957 * (radius / centre) ** 1.25, rel=1e-3)
