"""Mode shapes as meshes for other programs: one file per mode, speed and format.

``vtu`` and ``vtk`` hold the rotor at rest and its complex displacement; ``xdmf`` (with its ``h5``)
one period as a series of instants; ``glb`` the same as an animation; ``stl``, ``ply``, ``obj`` and
``off`` the deformed surface at the instant of largest motion. Lengths are in m.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from rotordyn.analyses.campbell.gltf import write_glb
from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.campbell.spec import CampbellSpec, ShapesInSpaceSpec
from rotordyn.analyses.contract import File
from rotordyn.arrays import Array, Complex
from rotordyn.errors import InvalidInput
from rotordyn.machine.spindle import Spindle
from rotordyn.results.described import Described
from rotordyn.results.display import RPM
from rotordyn.surface.body import Surface, together
from rotordyn.surface.motion import at_phase, drawn_scale, reach
from rotordyn.surface.orbit import phases
from rotordyn.surface.several import displacements, surfaces

FOLDER = "shapes_3d"
INSTANTS = 24  # of a period in a series


@dataclass(frozen=True, eq=False, slots=True)
class MovingSurface:
    """A surface [m] in one mode: complex ``shape`` (n, 3), scaled as in the results; the drawn
    displacement is ``scale`` [m] times that."""

    name: str
    surface: Surface
    shape: Complex
    scale: float

    @property
    def deformed(self) -> Array:
        """Points at the instant of largest motion [m]."""
        return self.surface.points + self.scale * self.shape.real

    @property
    def share(self) -> Array:
        """Largest displacement of each point over the largest of the mode [1]."""
        size = reach(self.shape)
        return size / (size.max() or 1.0)


def files(folder: Path, case: Described, result: CampbellResult) -> Iterator[File]:
    """Yield the meshes that a case requests, in a folder; a format may lack its package."""
    spec = case.analyses.get("campbell")
    shapes = spec.shapes_3d if isinstance(spec, CampbellSpec) else None
    if shapes is None or case.spindle is None or not result.shape.size:
        return
    for extension in shapes.files:
        single = replace(shapes, files=(extension,))
        write = partial(write_shapes, folder / FOLDER, case.spindle, result, single)
        yield f"{FOLDER}/*.{extension}", write


def write_shapes(
    folder: Path, spindle: Spindle, result: CampbellResult, spec: ShapesInSpaceSpec
) -> list[Path]:
    """Write every mode of ``result`` that has a shape into ``folder``; return the files."""
    if not spec.files:
        return []
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for moving in moving_surfaces(spindle, result, spec.amplitude):
        for extension in spec.files:
            path = folder / f"{moving.name}.{extension}"
            write_shape(path, moving)
            paths.append(path)
    return paths


def moving_surfaces(
    spindle: Spindle, result: CampbellResult, amplitude: float
) -> Iterator[MovingSurface]:
    """Yield each mode at each speed of its shapes; ``amplitude``: as in ``ShapesInSpaceSpec``."""
    parts, shaft = surfaces(spindle), spindle.shaft
    surface = together(list(parts.values()))
    length = amplitude * (shaft.end - shaft.start)
    for speed, mode in np.argwhere(np.isfinite(result.shape).all(axis=(2, 3))).tolist():
        shape = result.shape[speed, mode]
        motion = displacements(spindle, parts, result.node, result.node_rotor, shape)
        name = shape_name(result, speed, mode)
        yield MovingSurface(name, surface, motion, drawn_scale(motion, shape, length))


def shape_name(result: CampbellResult, speed: int, mode: int) -> str:
    """Return the file name of a mode at one of the speeds of the shapes: ``bending_1_0rpm``."""
    rpm = result.shape_speed[speed] * RPM.factor
    return f"{re.sub(r'[^a-z0-9]+', '_', result.mode[mode].lower())}_{rpm:.6g}rpm"


def write_shape(path: Path, moving: MovingSurface) -> None:
    """Write one mode in the format that the end of ``path`` names.

    Raises
    ------
    InvalidInput : there is no such format
    """
    extension = path.suffix.removeprefix(".")
    if extension not in _WRITERS:
        allowed = ", ".join(_WRITERS)
        raise InvalidInput(f"{path.name}: no mesh format '{extension}'; allowed: {allowed}")
    _WRITERS[extension](path, moving)


def _write_displacement(path: Path, moving: MovingSurface) -> None:
    points = {
        "displacement_re": moving.shape.real,
        "displacement_im": moving.shape.imag,
        "drawn": moving.scale * moving.shape.real,
        "share": moving.share,
    }
    cells = {"body": [moving.surface.body.astype(np.int32)]}
    mesh = _mesh(moving, moving.surface.points, point_data=points, cell_data=cells)
    mesh.write(path, file_format="vtk42" if path.suffix == ".vtk" else "vtu")


def _write_series(path: Path, moving: MovingSurface) -> None:
    import h5py
    from meshio.xdmf import TimeSeriesWriter

    content = BytesIO()  # HDF5 ends the process on a full disk, instead of an exception
    mesh, writer = _mesh(moving, moving.surface.points), TimeSeriesWriter(path)
    writer.h5_filename = str(path.with_suffix(".h5"))  # meshio would write into the working folder
    with h5py.File(content, "w") as writer.h5_file:
        writer.write_points_cells(mesh.points, mesh.cells)
        for number, phase in enumerate(phases(INSTANTS)):
            drawn = moving.scale * at_phase(moving.shape, float(phase))
            values = {"displacement": drawn, "share": moving.share}
            writer.write_data(number / INSTANTS, point_data=values)
        writer.__exit__()
    path.with_suffix(".h5").write_bytes(content.getbuffer())


def _write_deformed(path: Path, moving: MovingSurface) -> None:
    options = {".stl": {"binary": True}, ".ply": {"binary": True}}.get(path.suffix, {})
    _mesh(moving, moving.deformed).write(path, **options)


def _write_glb(path: Path, moving: MovingSurface) -> None:
    write_glb(
        path,
        name=moving.name,
        points=moving.surface.points,
        triangles=moving.surface.triangles,
        motion=moving.scale * moving.shape,
        share=moving.share,
    )


def _mesh(moving: MovingSurface, points: Array, **data: Any) -> Any:
    import meshio

    return meshio.Mesh(points, [("triangle", moving.surface.triangles.astype(np.int32))], **data)


_WRITERS: dict[str, Callable[[Path, MovingSurface], None]] = {
    "vtu": _write_displacement,
    "vtk": _write_displacement,
    "xdmf": _write_series,
    "glb": _write_glb,
    "stl": _write_deformed,
    "ply": _write_deformed,
    "obj": _write_deformed,
    "off": _write_deformed,
}
