"""Mode shapes in space: rendered in another process while the run goes on, then drawn."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.campbell.spec import CampbellSpec, ShapesInSpaceSpec
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput
from rotordyn.machine.spindle import Spindle
from rotordyn.view.apart import NoPictures, Rendering
from rotordyn.view.order import Order

if TYPE_CHECKING:
    from rotordyn.figures.draw import Figure, Job

FRAMES = 20  # of one period
Parts = Mapping[str, tuple[Case, Mapping[str, Any]]]


@dataclass(frozen=True, slots=True)
class LeftOut:
    """``figures`` that were not drawn -> why, and what the user is told of it."""

    figures: dict[str, str] = field(default_factory=dict)
    sentences: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False, slots=True)
class Asked:
    """The shapes of one part of a case, ``name`` being its folder."""

    name: str
    spindle: Spindle
    result: CampbellResult
    spec: ShapesInSpaceSpec

    @property
    def order(self) -> Order:
        """What is to be rendered."""
        frames = FRAMES if self.spec.animation else 0
        own = self.result
        return Order(self.spindle, own.node, own.node_rotor, own.shape, self.spec.amplitude, frames)

    def inside(self, file: str) -> str:
        """``file`` in the folder of this part."""
        return f"{self.name}/{file}" if self.name else file


class InSpace:
    """The pictures that ``parts`` ask for; a context, after which their files are gone.

    Nothing is started where none are asked for.
    """

    def __init__(self, parts: Parts) -> None:
        self.left_out = LeftOut()
        self._asked = [asked for asked in _every(parts) if asked.order.places]
        orders = [asked.order for asked in self._asked]
        self._rendering = Rendering(orders) if orders else None

    def __enter__(self) -> InSpace:
        return self

    def __exit__(self, *_: object) -> None:
        if self._rendering is not None:
            self._rendering.close()

    def draw(self, folder: Path) -> dict[str, float]:
        """Wait for the pictures, write figures and animations; seconds by figure.

        Where nothing can be rendered, ``left_out`` says so afterwards.
        """
        if self._rendering is None:
            return {}
        try:
            self._rendering.finish()
        except NoPictures as none:
            self.left_out = _left_out(self._asked, str(none))
            return {}
        from rotordyn.figures.draw import Drawing

        drawn = Drawing(_sheets(self._asked, self._rendering), folder).finish()
        return drawn | _animate(self._asked, self._rendering, folder)

    def sheet(self, name: str) -> Figure:
        """Wait for the pictures and draw one sheet.

        Raises
        ------
        NoPictures : nothing can be rendered
        """
        from rotordyn.figures.draw import drawn

        assert self._rendering is not None, "a sheet has a name where one is asked for"
        self._rendering.finish()
        return drawn(dict(_sheets(self._asked, self._rendering))[name])


def sheet_names(parts: Parts) -> tuple[str, ...]:
    """Names of the sheets that ``parts`` ask for."""
    from rotordyn.analyses.campbell.figures.shapes_3d import sheets

    return tuple(a.inside(name) for a in _every(parts) for name, *_ in sheets(a.result))


def sheet(parts: Parts, name: str) -> Figure:
    """Render and draw one sheet of ``sheet_names``.

    Raises
    ------
    InvalidInput : nothing can be rendered on this computer
    """
    with InSpace(parts) as space:
        try:
            return space.sheet(name)
        except NoPictures as none:
            raise InvalidInput(f"figure {name} cannot be drawn: {none}") from None


def write_meshes(case: Case, results: Mapping[str, Any], folder: Path) -> None:
    """The files of meshes that ``case`` asks for."""
    asked = _asked("", case, results)
    if asked is not None and asked.spec.files:
        from rotordyn.analyses.campbell.meshes import FOLDER, write_shapes

        write_shapes(folder / FOLDER, asked.spindle, asked.result, asked.spec)


def _every(parts: Parts) -> list[Asked]:
    found = (_asked(name, case, results) for name, (case, results) in parts.items())
    return [asked for asked in found if asked is not None]


def _asked(name: str, case: Case, results: Mapping[str, Any]) -> Asked | None:
    spec, result = case.analyses.get("campbell"), results.get("campbell")
    if not isinstance(spec, CampbellSpec) or spec.shapes_3d is None or case.spindle is None:
        return None
    if not isinstance(result, CampbellResult) or not result.shape.size:
        return None
    return Asked(name, case.spindle, result, spec.shapes_3d)


def _sheets(parts: list[Asked], rendering: Rendering) -> list[Job]:
    """Name and drawing function of every sheet, once the pictures are rendered."""
    from rotordyn.analyses.campbell.figures.shapes_3d import sheet_figure, sheets

    jobs: list[Job] = []
    for number, asked in enumerate(parts):
        picture = partial(rendering.still, number)
        for name, speed, modes in sheets(asked.result):
            draw = partial(sheet_figure, asked.result, speed, modes, picture, asked.order)
            jobs.append((asked.inside(name), draw))
    return jobs


def _animate(parts: list[Asked], rendering: Rendering, folder: Path) -> dict[str, float]:
    from rotordyn.analyses.campbell.figures.shapes_3d import save_animation
    from rotordyn.analyses.campbell.meshes import FOLDER, shape_name

    seconds = {}
    for number, asked in enumerate(parts):
        for speed, mode in asked.order.places if asked.spec.animation else ():
            begin = time.perf_counter()
            name = asked.inside(f"{FOLDER}/{shape_name(asked.result, speed, mode)}.gif")
            (folder / name).parent.mkdir(exist_ok=True)
            frames = rendering.moving(number, speed, mode)
            save_animation(folder / name, asked.result, speed, mode, frames, asked.order)
            seconds[name] = time.perf_counter() - begin
    return seconds


def _left_out(parts: list[Asked], why: str) -> LeftOut:
    """Every figure that is missing, and one sentence for all."""
    from rotordyn.analyses.campbell.figures.shapes_3d import sheets

    names = [asked.inside(name) for asked in parts for name, *_ in sheets(asked.result)]
    animated = any(asked.spec.animation for asked in parts)
    also = " and the animations" if animated else ""
    said = f"figures {', '.join(names)}{also} left out: {why}"
    return LeftOut(dict.fromkeys(names, why), (said,))
