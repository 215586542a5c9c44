"""Where a ball leaves its race: the zero of its approach, which its load tells by Hertz' law."""

from __future__ import annotations

import pytest

from rotordyn.preload.leaving import Leaving

STIFFNESS = 8e9  # N/m^1.5


def pressed(approach: float) -> float:
    return float(STIFFNESS * max(approach, 0.0) ** 1.5)


@pytest.mark.parametrize("bend", [0.0, 0.4, -0.3])
@pytest.mark.parametrize("zero", [0.41, 0.77])
def test_an_approach_that_falls_as_a_parabola_is_met_at_once(bend: float, zero: float) -> None:
    """From three loads; a straight one from two."""

    def load(share: float) -> float:
        return pressed(5e-6 * (zero - share) * (1.0 + bend * share))

    shares = [0.0, 0.2, 0.4]
    found = Leaving.between(shares, [load(s) for s in shares], 1.0, 0.0, 3)
    assert found.zero == pytest.approx(zero, rel=1e-9)
    if not bend:
        two = Leaving.between(shares[:2], [load(s) for s in shares[:2]], 1.0, 0.0, 3)
        assert two.zero == pytest.approx(zero, rel=1e-9)
        assert not two.found


@pytest.mark.parametrize("scale", [0.01, 1.0, 1e4])
def test_trials_stay_between_what_is_pressed_and_what_is_lost(scale: float) -> None:
    """An approach that a parabola does not follow, of loads in any unit: a tenth of the way is left
    by each, so that three lead within a thousandth."""
    zero, tried = 0.613 * scale, []

    def load(share: float) -> float:
        return pressed(5e-6 * ((1.0 + 0.613) ** 6 - (1.0 + share / scale) ** 6))

    begin = [0.0, 0.3 * scale, 0.5 * scale]
    here = Leaving.between(begin, [load(share) for share in begin], scale, 1e-9, 0)
    while not here.found:
        last, lost, trial = here.load[-1], here.lost, here.trial
        assert last < trial < lost
        tried.append(trial)
        here = here.after(trial, load(trial), 7)
        assert len(tried) <= 4
    assert len(tried) >= 2
    assert here.zero == pytest.approx(zero, rel=1e-6)
    assert here.ball == 7


@pytest.mark.parametrize("scale", [0.01, 1.0, 1e4])
@pytest.mark.parametrize(("apart", "enough"), [(2e-6, False), (0.5e-6, True)])
def test_bounds_a_millionth_apart_are_enough(scale: float, apart: float, *, enough: bool) -> None:
    here = Leaving.between([0.5 * scale], [1.0], 0.5 * scale * (1.0 + apart), 0.0, 0)
    assert here.found == enough


def test_a_load_at_which_one_has_left_bounds_from_above() -> None:
    """And only the nearest of those where all are pressed are kept."""
    here = Leaving.between([0.0], [pressed(2e-6)], 1.0, 1e-3, 4)
    assert here.zero == 1.0
    assert here.trial == pytest.approx(0.5)
    less = here.after(0.6, 1e-4, 9)
    assert (less.lost, less.ball, less.load) == (0.6, 4, (0.0,))
    for share in (0.1, 0.2, 0.3):
        less = less.after(share, pressed(1e-6 * (0.5 - share)), 9)
    assert less.load == (0.1, 0.2, 0.3)
    assert less.zero == pytest.approx(0.5)
