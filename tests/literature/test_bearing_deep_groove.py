"""A deep-groove bearing without clearance, static: a commercial code after ISO/TS 16281.

Z 7, Dw 11.5 mm, Dpw 43.5 mm, grooves 0.52 and 0.53 Dw, E 210 GPa, ν 0.3. Tolerance 0.5 %: that
code uses the approximate contact constants of the standard.
"""

from __future__ import annotations

import numpy as np
import pytest

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
