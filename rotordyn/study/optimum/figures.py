"""Goal over trials and over every parameter, and the trade-off of two goals."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.arrays import Array, Flags
from rotordyn.figures.labels import broken
from rotordyn.figures.legends import shortened
from rotordyn.figures.style import (
    BLUE,
    FONT_SIZE,
    GREY,
    ORANGE,
    add_axes,
    grid_boxes,
    head,
    new_figure,
)
from rotordyn.study.figures import abscissa, word_ticks
from rotordyn.study.optimum.problem import Trial
from rotordyn.study.optimum.solve import Optimum

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLUMNS, ROW = 2, 52.0  # mm
LONGEST = 52


def figures(optimum: Optimum) -> Iterator[tuple[str, Callable[[], Figure]]]:
    """Yield the name of every figure and the function that draws it."""
    if any(each.goals for each in optimum.trials):
        yield "optimum", partial(_over_choices, optimum)
    if len(optimum.front) > 1:
        yield "optimum_front", partial(_front, optimum)


def _over_choices(optimum: Optimum) -> Figure:
    """Draw the first goal over the trials and over every parameter."""
    problem = optimum.problem
    count = 1 + len(problem.parameters)
    rows = -(-count // COLUMNS)
    height = 22.0 + ROW * rows
    goal = shortened(problem.goals[0].words, LONGEST)
    title = f"trials: {goal} [{optimum.units[0]}] over what was chosen"
    figure = new_figure(height=height, title=title)
    boxes = grid_boxes(figure, rows, COLUMNS, margins=(16.0, 5.0, 20.0, 14.0), gaps=(18.0, 18.0))
    cost = [each.goals[0] if each.goals else np.nan for each in optimum.trials]
    feasible = np.array([each.feasible for each in optimum.trials])
    number = np.arange(len(cost), dtype=float)
    for k, box in enumerate(boxes[:count]):
        axes = add_axes(figure, box)
        if k:
            p = problem.parameters[k - 1]
            labels = [problem.labels(each.number)[p.path] for each in optimum.trials]
            _points(axes, optimum, abscissa(p, labels), np.array(cost), feasible)
            axes.set_xlabel(broken(p.heading, LONGEST), fontsize=FONT_SIZE - 1.0)
            word_ticks(axes, p)
        else:
            _points(axes, optimum, number, np.array(cost), feasible)
            axes.set_xlabel("trial", fontsize=FONT_SIZE - 1.0)
            if missing := int((~np.isfinite(cost)).sum()):
                axes.plot([], [], " ", label=f"without a goal: {missing} of {len(cost)}")
            handles, words = axes.get_legend_handles_labels()
            figure.legend(
                handles,
                words,
                loc="lower center",
                ncols=4,
                frameon=False,
                fontsize=FONT_SIZE - 1.0,
            )
    return head(figure, problem.case.title or problem.case.name)


def _points(axes: Axes, optimum: Optimum, x: Array, y: Array, feasible: Flags) -> None:
    axes.plot(x[~feasible], y[~feasible], "x", ms=3.5, mew=0.7, color=GREY, label="breaks a limit")
    axes.plot(x[feasible], y[feasible], "o", ms=2.5, color=BLUE, label="keeps all limits")
    if optimum.best is not None:
        k = optimum.trials.index(optimum.best)
        axes.plot(x[k], y[k], "*", ms=9.0, color=ORANGE, mec="black", mew=0.4, label="best")
    axes.margins(x=0.05, y=0.08)


def _front(optimum: Optimum) -> Figure:
    """Draw two goals against each other."""
    figure = new_figure(height=100.0, title="trade-off of two goals")
    axes = add_axes(figure, (24.0, 20.0, 130.0, 62.0))
    for feasible, marker, label in (
        (True, "o", "keeps all limits"),
        (False, "x", "breaks a limit"),
    ):
        x, y = _pairs([t for t in optimum.trials if t.goals and t.feasible is feasible])
        colour = BLUE if feasible else GREY
        axes.plot(x, y, marker, ms=2.5, color=colour, alpha=0.5, label=label)
    x, y = _pairs(optimum.front)
    axes.plot(x, y, "-D", ms=4.0, lw=1.0, color=ORANGE, mec="black", mew=0.4, label="front")
    start = optimum.start.goals
    axes.plot(*start, "^", ms=6.0, color="black", label="the unchanged case")
    axes.set_xlabel(f"{shortened(optimum.problem.goals[0].words, 70)} [{optimum.units[0]}]")
    axes.set_ylabel(f"{shortened(optimum.problem.goals[1].words, LONGEST)} [{optimum.units[1]}]")
    axes.legend(fontsize=FONT_SIZE - 1.0, loc="best")
    axes.margins(0.06)
    return head(figure, optimum.problem.case.title or optimum.problem.case.name)


def _pairs(trials: Sequence[Trial]) -> tuple[Array, Array]:
    """Values of both goals, (trials,) each."""
    pairs = np.array([each.goals for each in trials]).reshape(-1, 2)
    return pairs[:, 0], pairs[:, 1]
