"""Derivatives of headline numbers with respect to parameters of a case, one at a time.

``derivative`` is the plain one, ``elasticity`` the relative change of the result over that of the
parameter, ``over_range`` the linear change over the range of the parameter: κ of D. Noël (doctoral
thesis, 2013, equation 3.10).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from bearings.arguments import typed
from rotordyn.arrays import Array
from rotordyn.case.asked import Asked, certain, within_case
from rotordyn.case.case import Case
from rotordyn.case.tolerance import Tolerance
from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.results.headline import Number
from rotordyn.study.machines import Machines, lean

if TYPE_CHECKING:
    import xarray as xr


class Derivatives(NamedTuple):
    """Derivatives by number and path (numbers, paths); NaN without a number or a range."""

    derivative: Array
    elasticity: Array
    over_range: Array


def derivatives(asked: Asked, machines: Machines, numbers: Mapping[str, Number]) -> Derivatives:
    """Central differences with respect to every path."""
    ranges = {each.path: each for each in asked.ranges}
    machines.all([step.at(end) for step in asked.steps for end in (0.0, 1.0)])  # at once, and kept
    columns = [_column(each, ranges.get(each.path), machines, numbers) for each in asked.steps]
    table = np.array(columns).reshape(len(columns), 3, len(numbers))
    return Derivatives(*(table[:, k].T for k in range(3)))


def _column(
    step: Tolerance, over: Tolerance | None, machines: Machines, numbers: Mapping[str, Number]
) -> list[Array]:
    low, high = (machines.values(step.at(end)).numbers for end in (0.0, 1.0))
    change = np.array(
        [high[k].value - low[k].value if k in low and k in high else np.nan for k in numbers]
    )
    value = np.array([each.value for each in numbers.values()])
    slope = change / step.width
    with np.errstate(divide="ignore", invalid="ignore"):
        relative = slope * step.value / np.where(value == 0.0, np.nan, value)
    return [slope, relative, slope * (np.nan if over is None else over.width)]


@typed(InvalidInput, besides=["case"])
def sensitivities(case: Case, paths: Iterable[str] | Mapping[str, str | None]) -> xr.Dataset:
    """Derivatives of every headline number of ``case`` with respect to numbers at dotted ``paths``.

    ``paths`` may map each path to the range over which its influence is stated, as a tolerance:
    ``{"spindle.sleeves.front.spring.preload": "± 10 %"}``. ``*`` moves all items together, by the
    same share; the derivative is then by the first of them.

    Returns
    -------
    Dataset over ``number`` and ``path``: ``derivative`` (printed unit over SI unit), ``elasticity``
    (relative over relative), ``range_effect`` (printed unit; NaN without a range)

    Raises
    ------
    InvalidInput : a path that does not exist, is no number or zero; a range that is no tolerance
    NoSolution : the machine has no solution
    """
    import xarray as xr

    if not isinstance(case, Case):
        raise InvalidInput(f"sensitivities take a case, as rotordyn.load gives it: {shown(case)}")
    if isinstance(paths, str):
        paths = [paths]
    for path in paths:
        if not isinstance(path, str):
            raise InvalidInput(f"sensitivities: not a dotted path: given {shown(path)}")
    given: dict[str, Any] = dict(paths) if isinstance(paths, Mapping) else dict.fromkeys(paths)
    asked = within_case(certain(case), given)
    machines = Machines(lean(case))
    numbers = machines.values({}).numbers
    if not numbers:
        raise InvalidInput(machines.lost[0] if machines.lost else "the case has no numbers")
    result = derivatives(asked, machines, numbers)
    dims = ("number", "path")
    return xr.Dataset(
        {
            "derivative": (dims, result.derivative, {"long_name": "derivative, by SI unit"}),
            "elasticity": (
                dims,
                result.elasticity,
                {"long_name": "relative derivative", "units": "1"},
            ),
            "range_effect": (dims, result.over_range, {"long_name": "κ, change over the range"}),
            "nominal": ("number", [each.value for each in numbers.values()]),
            "unit": ("number", [each.unit for each in numbers.values()]),
        },
        {"number": [*numbers], "path": [*given]},
    )
