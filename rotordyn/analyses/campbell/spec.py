"""Specification of modes over speed (SI)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description, Faults, ascending, repeated
from rotordyn.quantity import Amplitude, Choice, EngineOrder, Frequency, Whole
from rotordyn.scene.spec import Setting, Spec

MESH_FILES = ("vtu", "vtk", "xdmf", "glb", "stl", "ply", "obj", "off")
MOST_TEETH = 1000
PASSING = ("cage", "outer", "inner", "ball")  # fields of bearings.life.Frequencies


@dataclass(frozen=True, slots=True)
class ShapesInSpaceSpec(Description):
    """Mode shapes in space, at the first and the last speed."""

    amplitude: Annotated[Amplitude, "largest displacement drawn, over the length of the shaft"] = (
        0.06
    )
    animation: Annotated[bool, "one period of each mode as a GIF"] = False
    files: Annotated[
        tuple[Annotated[str, Choice(MESH_FILES)], ...],
        "formats of the mesh files for other programs",
    ] = ()

    def _faults(self) -> Faults:
        yield from repeated("files", self.files)


@dataclass(frozen=True, slots=True)
class CampbellSpec(Spec):
    """Damped modes over speed."""

    max_frequency: Annotated[Frequency, "modes that are below it at any speed are followed"] = (
        4000.0
    )
    teeth: Annotated[
        tuple[Annotated[int, Whole(1, MOST_TEETH)], ...],
        "numbers of cutter teeth whose tooth passing frequency is drawn",
    ] = ()
    shapes: Annotated[bool, "keep the mode shapes at the first and last speed"] = True
    shapes_3d: Annotated[
        ShapesInSpaceSpec | None,
        "mode shapes drawn in three dimensions and written as meshes ([how](theory/shapes.md))",
    ] = None
    engine_orders: Annotated[
        tuple[EngineOrder, ...],
        "multiples of the speed, integer or not, for which critical speeds are computed",
    ] = (1.0,)

    bearing_frequencies: Annotated[
        tuple[Annotated[str, Choice(PASSING)], ...],
        "defect frequencies of every bearing that are drawn: `cage`, `outer` and `inner` race, "
        "`ball` ([theory](theory/life.md#defect-frequencies))",
    ] = ()

    def _faults(self) -> Faults:
        yield from ascending("teeth", self.teeth)
        yield from ascending("engine_orders", self.engine_orders)
        yield from repeated("bearing_frequencies", self.bearing_frequencies)
        if self.shapes_3d is not None and not self.shapes:
            yield ("shapes_3d",), "needs the shapes: given shapes: false"

    def faults_on(self, setting: Setting) -> Faults:
        if self.bearing_frequencies and not setting.spindle.seats:
            yield ("bearing_frequencies",), "needs bearings: this spindle has none"
