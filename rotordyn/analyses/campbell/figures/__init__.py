"""Figures: damped modes over speed and their critical speeds."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from rotordyn.analyses.campbell.figures.diagram import highest_of, orders, short
from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.figures.mode_lines import LOOKS, jumps, look_of
from rotordyn.figures.panels import Panel
from rotordyn.results.described import Described, Shown
from rotordyn.results.display import RPM
from rotordyn.results.headline import Curve, curves_of

code = partial(Code, __name__)


def figures(case: Described, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    """Yield the figures of a result."""
    spec = case.analyses.get("campbell")
    teeth, highest = getattr(spec, "teeth", ()), getattr(spec, "max_frequency", 0.0)
    known = case.known
    yield "campbell", partial(code("diagram:campbell_figure"), result, teeth, known, highest)
    if result.unstable.any() and result.speed.size > 1:
        yield "damping", partial(code("damping:damping_figure"), result)
    if result.shape_speed.size and result.node.size:
        yield "mode_shapes", partial(code("shapes:shapes_figure"), result, case.spindle)


def panels(spec: Any, variants: Sequence[Shown]) -> Iterator[Panel]:
    """Yield the diagram of every variant, and its damping where some have unstable modes."""
    draw = partial(code("diagram:draw_variant"), getattr(spec, "teeth", ()))
    top = partial(code("diagram:highest_of"), getattr(spec, "max_frequency", 0.0))
    layout: dict[str, Any] = {"margins": (15.0, 22.0, 12.0, 8.0), "gaps": (38.0, 13.0)}
    yield Panel("campbell", draw, top, **layout)
    unstable = any(variant.result.unstable.any() for variant in variants)
    if unstable and variants[0].result.speed.size > 1:
        limits = code("damping:limits_of")
        yield Panel("damping", code("damping:draw_variant"), limits, tall=52.0)


def headline_curves(spec: Any, variant: Shown) -> Iterator[Curve]:
    """Yield every mode, dashes by whirl, and the lines of excitation."""
    result: Any = variant.result
    top = getattr(spec, "max_frequency", 0.0) or highest_of(0.0, [variant])
    options: dict[str, Any] = {"figure": "campbell_overlay", "limits": (0.0, top)}
    breaks = jumps(result)
    modes = [*curves_of(result, "frequency", series="mode", **options)]
    looks = [look_of(*each) for each in zip(result.kind, result.whirl[-1], strict=True)]
    for k in sorted(
        np.flatnonzero(~result.mostly_overdamped), key=lambda k: [*LOOKS].index(looks[k])
    ):
        look = LOOKS[looks[k]][2]
        yield modes[k]._replace(series=look, breaks=breaks[:, k], end=short(result.mode[k]))
    rpm = np.array([0.0, result.speed[-1] * RPM.factor])
    for order, name in orders(result, getattr(spec, "teeth", ())).items() if modes else ():
        yield modes[0]._replace(x=rpm, y=order * rpm / 60.0, series=name, backdrop=True)
