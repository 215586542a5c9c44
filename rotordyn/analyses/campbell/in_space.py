"""Mode shapes in space: rendered in another process while the run goes on, then drawn."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.campbell.spec import CampbellSpec, ShapesInSpaceSpec
from rotordyn.errors import InvalidInput
from rotordyn.figures.draw import Omitted
from rotordyn.machine.spindle import Spindle
from rotordyn.results.described import Described
from rotordyn.view.apart import NoPictures, Rendering
from rotordyn.view.order import Order

if TYPE_CHECKING:
    from rotordyn.figures.draw import Figure, Job

FRAMES = 20  # of one period
Parts = Mapping[str, tuple[Described, CampbellResult]]


@dataclass(frozen=True, eq=False, slots=True)
class PartShapes:
    """The shapes of one part of a case, ``name`` being its folder."""

    name: str
    title: str
    spindle: Spindle
    result: CampbellResult
    spec: ShapesInSpaceSpec

    @property
    def order(self) -> Order:
        """Order of the pictures to render."""
        frames = FRAMES if self.spec.animation else 0
        result = self.result
        return Order(
            self.spindle, result.node, result.node_rotor, result.shape, self.spec.amplitude, frames
        )

    @property
    def heading(self) -> str:
        """Heading of its pictures."""
        return "  |  ".join(dict.fromkeys([self.spindle.title or self.spindle.name, self.title]))

    def inside(self, file: str) -> str:
        """Return the path of ``file`` in the folder of this part."""
        return f"{self.name}/{file}" if self.name else file


class InSpace:
    """Pictures that ``parts`` request, rendered within this context; their files are removed then.

    Nothing is started where none are requested. ``folder``: of these files, None for that of the
    system.
    """

    def __init__(self, parts: Parts, folder: Path | None) -> None:
        self.omitted = Omitted()
        pictures = (_part_shapes(name, case, result) for name, (case, result) in parts.items())
        self._parts = [part for part in pictures if part is not None and part.order.places]
        self._folder = folder
        self._rendering: Rendering | None = None

    def __enter__(self) -> InSpace:
        orders = [part.order for part in self._parts]
        self._rendering = Rendering(orders, self._folder) if orders else None
        return self

    def __exit__(self, *_: object) -> None:
        if self._rendering is not None:
            self._rendering.close()

    def draw(self, folder: Path, formats: Sequence[str]) -> dict[str, float]:
        """Wait for the pictures, write figures and animations; seconds by figure.

        Where nothing can be rendered, ``omitted`` says so afterwards.
        """
        if self._rendering is None:
            return {}
        try:
            self._rendering.finish()
        except NoPictures as failure:
            self.omitted = _omitted(self._parts, str(failure))
            return {}
        from rotordyn.figures.draw import Drawing

        jobs = _sheets(self._parts, self._rendering)
        with Drawing(jobs, folder, formats=formats) as drawing:
            drawn = drawing.finish()
        return drawn | _animate(self._parts, self._rendering, folder)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the sheets."""
        return _names(self._parts)

    @property
    def count(self) -> int:
        """Number of pictures and frames of animations."""
        return sum(part.order.pictures for part in self._parts)

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
        except NoPictures as failure:
            raise InvalidInput(f"figure {name} cannot be drawn: {failure}") from None
        return drawn(dict(_sheets(self._parts, self._rendering))[name])


def _part_shapes(name: str, case: Described, result: CampbellResult) -> PartShapes | None:
    spec = case.analyses.get("campbell")
    if not isinstance(spec, CampbellSpec) or spec.shapes_3d is None or case.spindle is None:
        return None
    if not result.shape.size:
        return None
    return PartShapes(name, case.title, case.spindle, result, spec.shapes_3d)


def _sheets(parts: list[PartShapes], rendering: Rendering) -> list[Job]:
    """Return name and drawing function of every sheet, once the pictures are rendered."""
    from rotordyn.analyses.campbell.figures.shapes_3d import sheet_figure, sheets
    from rotordyn.figures.draw import titled

    jobs: list[Job] = []
    for number, part in enumerate(parts):
        picture = partial(rendering.still, number)
        for name, speed, modes in sheets(part.result):
            draw = partial(sheet_figure, part.result, speed, modes, picture, part.order)
            jobs.append((part.inside(name), partial(titled, draw, part.heading)))
    return jobs


def _names(parts: list[PartShapes]) -> tuple[str, ...]:
    from rotordyn.analyses.campbell.figures.shapes_3d import sheets

    return tuple(part.inside(name) for part in parts for name, *_ in sheets(part.result))


def _animate(parts: list[PartShapes], rendering: Rendering, folder: Path) -> dict[str, float]:
    from rotordyn.analyses.campbell.figures.shapes_3d import save_animation
    from rotordyn.analyses.campbell.meshes import FOLDER, shape_name

    seconds = {}
    for number, part in enumerate(parts):
        for speed, mode in part.order.places if part.spec.animation else ():
            begin = time.perf_counter()
            name = part.inside(f"{FOLDER}/{shape_name(part.result, speed, mode)}.gif")
            (folder / name).parent.mkdir(exist_ok=True)
            frames = rendering.moving(number, speed, mode)
            save_animation(
                folder / name, part.result, speed, mode, frames, part.order, part.heading
            )
            seconds[name] = time.perf_counter() - begin
    return seconds


def _omitted(parts: list[PartShapes], why: str) -> Omitted:
    """Return every figure that is missing, and one sentence for all."""
    names = _names(parts)
    animated = any(part.spec.animation for part in parts)
    also = " and the animations" if animated else ""
    sentence = f"figures {', '.join(names)}{also} omitted: {why}"
    return Omitted(dict.fromkeys(names, why), (sentence,))
