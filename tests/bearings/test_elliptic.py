"""The elliptic integrals behind every contact against those of scipy."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import ellipe, ellipkm1

from bearings.contact.hertz import _integrals


@pytest.mark.parametrize("kappa", [1.0 + 1e-9, 1.01, 2.0, 4.6, 30.0, 1e4, 1e7])
def test_integrals_to_rounding(kappa: float) -> None:
    first, second = _integrals(kappa)
    assert first == pytest.approx(float(ellipkm1(kappa**-2)), rel=1e-14)
    assert second == pytest.approx(float(ellipe(1.0 - kappa**-2)), rel=1e-13)


def test_circle() -> None:
    assert _integrals(1.0) == pytest.approx((np.pi / 2, np.pi / 2), rel=1e-15)
