"""A figure of it."""

from __future__ import annotations

from functools import partial

from rotordyn.figures.style import add_axes, new_figure


def figures(case, result, results):
    """One line over speed."""
    yield "nose_sag", partial(draw, result)


def draw(result):
    """Weight over speed."""
    figure = new_figure(100.0, 80.0)
    axes = add_axes(figure, (15.0, 12.0, 80.0, 60.0), "speed [rad/s]", "weight [N]")
    axes.plot(result.speed, result.weight)
    return figure
