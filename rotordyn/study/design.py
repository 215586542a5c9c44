"""The points of a study: every combination of values, rows of a list, or a random sample."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import repeat
from typing import Any

import numpy as np

from rotordyn.arrays import Array
from rotordyn.case.case import Case
from rotordyn.case.paths import found_at
from rotordyn.case.study import MOST_DRAWN, SAMPLED, SAMPLINGS
from rotordyn.case.vary import changed
from rotordyn.description import unchecked
from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.quantity import suggestion
from rotordyn.study.latin_hypercube import latin_hypercube
from rotordyn.study.parameter import (
    Parameter,
    is_whole,
    parameters,
    require_each_once,
    require_whole,
)


def one_machine(case: Case, varied: Collection[str]) -> Case:
    """Return the case without its variants and uncertainties, which studies ignore.

    Raises
    ------
    InvalidInput : the case compares tools, and ``varied`` does not say which to take
    """
    tools = [each.tool for each in case.variants.values()]
    compared = len(tools) > 1 and tools[0] == case.tool and tools.count(case.tool) == 1
    if compared and "tool" not in varied:
        raise InvalidInput(
            f"the case compares {len(tools)} tools, a study solves one machine: give the case one "
            f"tool, or vary it (tool: [{', '.join(case.variants)}])"
        )
    return replace(case, variants={}, uncertain=None)


@dataclass(frozen=True, eq=False)
class Design:
    """The points of a study, numbered from 0; in a grid the last parameter varies fastest.

    ``samples``: number of points of a random sample, drawn with ``seed`` when first needed; None
    for a grid or a list.
    """

    parameters: tuple[Parameter, ...]
    sampling: str
    samples: int | None = None
    seed: int = 0

    @cached_property
    def shares(self) -> Array | None:
        """Coordinates of a sample (points, parameters) in [0, 1); None for a grid or a list."""
        if self.samples is None:
            return None
        if self.sampling == "latin-hypercube":
            return latin_hypercube(self.samples, len(self.parameters), self.seed)
        from scipy.stats import qmc

        return np.asarray(qmc.Sobol(len(self.parameters), rng=self.seed).random(self.samples))

    @property
    def shape(self) -> tuple[int, ...]:
        """Points along each dimension: one dimension for each parameter of a grid, else one."""
        if self.samples is not None:
            return (self.samples,)
        sizes = tuple(len(each.values) for each in self.parameters)
        return sizes if self.sampling == "grid" else sizes[:1]

    @property
    def count(self) -> int:
        """Number of points."""
        return math.prod(self.shape)

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the dimensions: the dotted paths in a grid, else ``point``."""
        return tuple(p.path for p in self.parameters) if self.sampling == "grid" else ("point",)

    def point(self, number: int) -> dict[str, Any]:
        """Values of a point by dotted path, as ``vary`` takes them."""
        if self.shares is not None:
            shares = self.shares[number]
            return {p.path: p.at(float(s)) for p, s in zip(self.parameters, shares, strict=True)}
        return {p.path: p.values[k] for p, k in self._places(number)}

    def labels(self, number: int) -> dict[str, Any]:
        """Coordinates of a point by dotted path: numbers in SI units, or words."""
        values = self.point(number)
        if self.shares is None:
            return {p.path: p.labels[k] for p, k in self._places(number)}
        return {p.path: _label(p, values[p.path]) for p in self.parameters}

    def _places(self, number: int) -> Iterator[tuple[Parameter, int]]:
        """Pairs of a parameter and the index of the point's value."""
        if self.sampling != "grid":
            return zip(self.parameters, repeat(number))
        indices = []
        for size in reversed(self.shape):
            number, index = divmod(number, size)
            indices.append(index)
        return zip(self.parameters, reversed(indices), strict=True)


def _label(of: Parameter, value: Any) -> Any:
    """Coordinate of a sampled value; a listed one is looked up by identity, whatever its type."""
    if of.ends is not None:
        return value
    return of.labels[next(k for k, each in enumerate(of.values) if each is value)]


def design(
    case: Case,
    varied: Mapping[str, object],
    sampling: str = "grid",
    samples: int | None = None,
    seed: int = 0,
) -> Design:
    """Build the design of a study and check it against the case.

    Raises
    ------
    InvalidInput : see ``parameter``; an unknown sampling, spans without a count in a grid, lists of
        different lengths, a number of samples that the method does not take
    """
    if sampling not in SAMPLINGS:
        hint = suggestion(sampling, SAMPLINGS)
        raise InvalidInput(
            f"sampling: given {shown(sampling)}; allowed: {', '.join(SAMPLINGS)}{hint}"
        )
    varied_parameters = tuple(parameters(case, varied))
    if sampling in SAMPLED:
        _require_sample(sampling, samples, seed)
        drawn = Design(varied_parameters, sampling, samples, seed)
        _require_begun(case, drawn)
        return drawn
    if samples is not None:
        raise InvalidInput(
            f"samples: a {sampling} has no samples; allowed with {' or '.join(SAMPLED)}"
        )
    for parameter in varied_parameters:
        if not parameter.values:
            raise InvalidInput(
                f"{parameter.path}: a {sampling} needs values: list them, or give the span a count "
                "(points, in a file)"
            )
    listed = Design(varied_parameters, sampling)
    _require_fitting(listed)
    _require_begun(case, listed)
    return listed


def _require_begun(case: Case, points: Design) -> None:
    """Check that paths into an absent part of the case together define it; the rules between values
    are checked at each point."""
    if not all(found_at(case, each.path) for each in points.parameters):
        with unchecked():
            changed(case, points.point(0))


def _require_fitting(whole: Design) -> None:
    varied = whole.parameters
    if whole.sampling == "grid":
        require_each_once(varied)
    elif len({len(each.values) for each in varied}) > 1:
        given = ", ".join(f"{each.path} {len(each.values)}" for each in varied)
        raise InvalidInput(f"a list has as many values of every path: got {given}")


def _require_sample(sampling: str, samples: Any, seed: Any) -> None:
    if samples is None:
        raise InvalidInput(
            f"samples: missing key: {sampling} needs how many points are drawn; allowed: a whole "
            f"number from 1 to {MOST_DRAWN:g}"
        )
    if not is_whole(samples, 1, MOST_DRAWN):
        raise InvalidInput(
            f"samples: given {shown(samples)}; {sampling} needs a whole number, up to "
            f"{MOST_DRAWN:g}, since a sample is drawn whole; a grid may have more"
        )
    require_whole("seed", seed, 0)
    if sampling == "sobol" and samples & (samples - 1):
        near = 2 ** round(math.log2(samples))
        raise InvalidInput(
            f"samples: given {samples}; a Sobol sequence is balanced for powers of two alone: "
            f"take {near}"
        )
