"""Which interference of the tolerances of a fit is taken."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rotordyn.machine.fits import Fits

# 70 k5 in a bore 0/−15 µm: 2 to 30 µm, probable 6 to 26 (SKF, catalogue 6000: 1 µm)
PRINTED = {"least": 2.0, "mean": 16.0, "most": 30.0, "probable_least": 6.0, "probable_most": 26.0}


@pytest.mark.parametrize("word", PRINTED)
def test_interference_taken_is_the_printed_one(word: str) -> None:
    fits = Fits(shaft="k5", rings="normal", bore_diameter=0.07, taken=word)
    assert 2e6 * fits.depth("inner") == pytest.approx(PRINTED[word], abs=0.1)
    rough = replace(fits, smoothing=3e-6)
    assert fits.depth("inner") - rough.depth("inner") == pytest.approx(1.5e-6)
