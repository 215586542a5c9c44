"""Mode shapes in space: rendered in another process while the run goes on, then drawn."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.campbell.spec import CampbellSpec, ShapesInSpaceSpec
from rotordyn.errors import InvalidInput
from rotordyn.figures.draw import LeftOut
from rotordyn.machine.spindle import Spindle
from rotordyn.results.described import Described
from rotordyn.view.apart import NoPictures, Rendering
from rotordyn.view.order import Order

if TYPE_CHECKING:
    from rotordyn.figures.draw import Figure, Job

FRAMES = 20  # of one period
Parts = Mapping[str, tuple[Described, CampbellResult]]


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
    """The pictures that ``parts`` ask for; rendered inside this context, then their files are gone.

    Nothing is started where none are asked for. ``folder``: where their files are meanwhile, None
    for the system's.
    """

    def __init__(self, parts: Parts, folder: Path | None) -> None:
        self.left_out = LeftOut()
        found = (_asked(name, case, result) for name, (case, result) in parts.items())
        self._asked = [asked for asked in found if asked is not None and asked.order.places]
        self._folder = folder
        self._rendering: Rendering | None = None

    def __enter__(self) -> InSpace:
        orders = [asked.order for asked in self._asked]
        self._rendering = Rendering(orders, self._folder) if orders else None
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

    @property
    def names(self) -> tuple[str, ...]:
        """Of the sheets."""
        return _names(self._asked)

    def figure(self, name: str) -> Figure:
        """Wait for the pictures and draw one sheet.

        Raises
        ------
        InvalidInput : nothing can be rendered on this computer
        """
        from rotordyn.figures.draw import drawn

        assert self._rendering is not None, "drawn inside the context"
        try:
            self._rendering.finish()
        except NoPictures as none:
            raise InvalidInput(f"figure {name} cannot be drawn: {none}") from None
        return drawn(dict(_sheets(self._asked, self._rendering))[name])


def _asked(name: str, case: Described, result: CampbellResult) -> Asked | None:
    spec = case.analyses.get("campbell")
    if not isinstance(spec, CampbellSpec) or spec.shapes_3d is None or case.spindle is None:
        return None
    return Asked(name, case.spindle, result, spec.shapes_3d) if result.shape.size else None


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


def _names(parts: list[Asked]) -> tuple[str, ...]:
    from rotordyn.analyses.campbell.figures.shapes_3d import sheets

    return tuple(asked.inside(name) for asked in parts for name, *_ in sheets(asked.result))


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
    names = _names(parts)
    animated = any(asked.spec.animation for asked in parts)
    also = " and the animations" if animated else ""
    said = f"figures {', '.join(names)}{also} left out: {why}"
    return LeftOut(dict.fromkeys(names, why), (said,))
