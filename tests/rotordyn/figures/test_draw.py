"""Figures leave nothing behind in the process that draws them."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Iterator
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from rotordyn.figures.draw import draw_one


@pytest.fixture
def thawed() -> Iterator[None]:
    """The collector as users have it: the tests' own one is frozen, and runs by itself."""
    gc.unfreeze()
    gc.disable()
    yield
    gc.enable()
    gc.freeze()


@pytest.mark.usefixtures("thawed")
def test_a_figure_is_freed_once_it_is_saved(tmp_path: Path) -> None:
    """With the pixels that its texts hold, 11 MB of a page, without the collector's own rounds."""
    seen: list[weakref.ref[Figure]] = []

    def draw() -> Figure:
        figure = Figure()
        figure.subplots().set_title("a text")
        seen.append(weakref.ref(figure))
        return figure

    draw_one("one", draw, tmp_path)
    assert seen[0]() is None
    assert gc.get_freeze_count() == 0


@pytest.mark.usefixtures("thawed")
def test_the_collector_is_as_before_where_a_figure_fails(tmp_path: Path) -> None:
    with pytest.raises(ZeroDivisionError):
        draw_one("one", lambda: 1 / 0, tmp_path)  # type: ignore[arg-type, return-value]
    assert gc.get_freeze_count() == 0


def test_objects_that_a_caller_has_frozen_stay_frozen(tmp_path: Path) -> None:
    gc.freeze()
    frozen = gc.get_freeze_count()
    draw_one("one", Figure, tmp_path)
    assert gc.get_freeze_count() == pytest.approx(frozen, rel=1e-3)
