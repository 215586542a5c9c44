"""Changes by refinement over the largest value of each point."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.scene.refinement import AT_REST, relative_change


def test_rounding_of_what_stands_still_is_no_change() -> None:
    coarse = np.array([[1.0, 3e-16, 1e-3], [2.0, -2e-16, 2e-3]])
    fine = np.array([[1.01, -1e-16, 1.1e-3], [2.0, 1e-16, 2e-3]])
    alone = relative_change(coarse, fine, 1)
    assert alone == pytest.approx([0.005, 4.0, 0.05])
    assert relative_change(coarse, fine, 1, AT_REST) == pytest.approx([0.005, 0.0, 0.05], abs=1e-9)
    assert relative_change(coarse, 0.0 * fine, 1, AT_REST) == pytest.approx([0.0, 0.0, 0.0])
