"""What a case asks of damped modes over speed (SI)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description, ascending, doubled
from rotordyn.quantity import Amplitude, Choice, EngineOrder, Frequency, Whole

MESH_FILES = ("vtu", "vtk", "xdmf", "glb", "stl", "ply", "obj", "off")
MOST_TEETH = 1000


@dataclass(frozen=True, slots=True)
class ShapesInSpaceSpec(Description):
    """Mode shapes in space: how they are drawn, and the files of meshes that other programs read.

    ``amplitude``: largest displacement drawn, over the length of the shaft; ``animation``: one
    period of each mode as a GIF; ``files``: of ``MESH_FILES``.
    """

    amplitude: Amplitude = 0.06
    animation: bool = False
    files: tuple[Annotated[str, Choice(MESH_FILES)], ...] = ()

    def _faults(self) -> Iterator[str]:
        for name in doubled(self.files):
            yield f"files: repeated: given '{name}'"


@dataclass(frozen=True, slots=True)
class CampbellSpec(Description):
    """Damped eigenfrequencies up to ``max_frequency`` [Hz] over speed.

    ``teeth``: numbers of cutter teeth whose tooth-passing line is of interest; ``shapes``: keep the
    mode shapes at the first and the last speed; ``shapes_3d``: see them in space;
    ``engine_orders``: multiples of the speed, whole or not, whose critical speeds are solved for.
    """

    max_frequency: Frequency = 4000.0
    teeth: tuple[Annotated[int, Whole(1, MOST_TEETH)], ...] = ()
    shapes: bool = True
    shapes_3d: ShapesInSpaceSpec | None = None
    engine_orders: tuple[EngineOrder, ...] = (1.0,)

    def _faults(self) -> Iterator[str]:
        yield from ascending("teeth", self.teeth)
        yield from ascending("engine_orders", self.engine_orders)
        if self.shapes_3d is not None and not self.shapes:
            yield "shapes_3d needs the shapes: given shapes False; allowed: True"
