"""How the search went, what each choice does to the goal, and the trade-off of two goals."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

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
from rotordyn.results.kinds import Array, Flags
from rotordyn.study.figures import abscissa, word_ticks
from rotordyn.study.optimum.problem import Trial
from rotordyn.study.optimum.solve import Optimum

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLUMNS, ROW = 2, 52.0  # mm
LONGEST = 52


def figures(found: Optimum) -> Iterator[tuple[str, Callable[[], Figure]]]:
    """Name and drawing of every figure."""
    if any(each.goals for each in found.trials):
        yield "optimum", partial(_over_choices, found)
    if len(found.front) > 1:
        yield "optimum_front", partial(_front, found)


def _over_choices(found: Optimum) -> Figure:
    """The first goal over the trials and over every parameter."""
    problem = found.problem
    count = 1 + len(problem.parameters)
    rows = -(-count // COLUMNS)
    height = 22.0 + ROW * rows
    goal = shortened(problem.goals[0].words, LONGEST)
    title = f"trials: {goal} [{found.units[0]}] over what was chosen"
    figure = new_figure(height=height, title=title)
    boxes = grid_boxes(figure, rows, COLUMNS, margins=(16.0, 5.0, 20.0, 14.0), gaps=(18.0, 18.0))
    cost = [each.goals[0] if each.goals else np.nan for each in found.trials]
    good = np.array([each.feasible for each in found.trials])
    number = np.arange(len(cost), dtype=float)
    for k, box in enumerate(boxes[:count]):
        axes = add_axes(figure, box)
        if k:
            p = problem.parameters[k - 1]
            labels = [problem.labels(each.number)[p.path] for each in found.trials]
            _points(axes, found, abscissa(p, labels), np.array(cost), good)
            axes.set_xlabel(broken(p.heading, LONGEST), fontsize=FONT_SIZE - 1.0)
            word_ticks(axes, p)
        else:
            _points(axes, found, number, np.array(cost), good)
            axes.set_xlabel("trial", fontsize=FONT_SIZE - 1.0)
            if none := int((~np.isfinite(cost)).sum()):
                axes.plot([], [], " ", label=f"without a goal: {none} of {len(cost)}")
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


def _points(axes: Axes, found: Optimum, x: Array, y: Array, good: Flags) -> None:
    axes.plot(x[~good], y[~good], "x", ms=3.5, mew=0.7, color=GREY, label="breaks a limit")
    axes.plot(x[good], y[good], "o", ms=2.5, color=BLUE, label="keeps all limits")
    if found.best is not None:
        k = found.trials.index(found.best)
        axes.plot(x[k], y[k], "*", ms=9.0, color=ORANGE, mec="black", mew=0.4, label="best")
    axes.margins(x=0.05, y=0.08)


def _front(found: Optimum) -> Figure:
    """Two goals against each other."""
    figure = new_figure(height=100.0, title="trade-off of two goals")
    axes = add_axes(figure, (24.0, 20.0, 130.0, 62.0))
    for good, look, words in ((True, "o", "keeps all limits"), (False, "x", "breaks a limit")):
        x, y = _pairs([t for t in found.trials if t.goals and t.feasible is good])
        colour = BLUE if good else GREY
        axes.plot(x, y, look, ms=2.5, color=colour, alpha=0.5, label=words)
    x, y = _pairs(found.front)
    axes.plot(x, y, "-D", ms=4.0, lw=1.0, color=ORANGE, mec="black", mew=0.4, label="front")
    start = found.start.goals
    axes.plot(*start, "^", ms=6.0, color="black", label="the case as it stands")
    axes.set_xlabel(f"{shortened(found.problem.goals[0].words, 70)} [{found.units[0]}]")
    axes.set_ylabel(f"{shortened(found.problem.goals[1].words, LONGEST)} [{found.units[1]}]")
    axes.legend(fontsize=FONT_SIZE - 1.0, loc="best")
    axes.margins(0.06)
    return head(figure, found.problem.case.title or found.problem.case.name)


def _pairs(trials: Sequence[Trial]) -> tuple[Array, Array]:
    """Both goals (trials,) of trials that have a solution."""
    pairs = np.array([each.goals for each in trials]).reshape(-1, 2)
    return pairs[:, 0], pairs[:, 1]
