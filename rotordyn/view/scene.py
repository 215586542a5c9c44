"""Rotors in space, in any of their modes at any instant: the only file that uses pyvista."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Complex, Indices
from rotordyn.machine.spindle import Spindle
from rotordyn.surface.body import Surface, together
from rotordyn.surface.motion import at_phase, drawn_scale, reach
from rotordyn.surface.orbit import orbit, turning
from rotordyn.surface.projection import projected, screen
from rotordyn.surface.rotor import orbit_stations
from rotordyn.surface.several import displacements, holders, section_motions, surfaces

Pixels = NDArray[np.uint8]
TURNING = {1: "#0072B2", -1: "#D55E00", 0: "#222222"}
EDGE, REST, HOLDER, AXIS = "#3F4A42", "#8A9097", "#7D8FA3", "#222222"
SHARP = 30.0  # degrees between facets from which an edge is sharp
THROUGH = 0.45  # opacity of a rotor that may hide another one
SMOOTH = 72  # points of an orbit
ALONG_AXIS = 120  # points of the deflected axis
BESIDE, IN_FRONT = -4.0, -66000.0  # units of depth by which lines are moved towards the viewer


class RotorScene:
    """A window off screen, ``width`` pixels wide, with the rotor of ``spindle`` in it.

    ``amplitude``, ``colours``: as in an ``Order``.
    """

    def __init__(self, spindle: Spindle, amplitude: float, colours: str, width: int) -> None:
        import pyvista

        self._spindle = spindle
        self._length = spindle.shaft.end - spindle.shaft.start
        self._reach = amplitude * self._length
        self._pixel = width / 1200.0  # width of lines
        self._parts = surfaces(spindle)
        self._surface = together(list(self._parts.values()))
        parts = spindle.parts
        self._orbits = {name: np.array(orbit_stations(part)) for name, part in parts.items()}
        self._along = {
            name: np.linspace(part.shaft.start, part.shaft.end, ALONG_AXIS)
            for name, part in parts.items()
        }
        self._stations = _on_axis(np.concatenate(list(self._orbits.values())))
        self._axis_at_rest = _on_axis(np.concatenate(list(self._along.values())))
        frame = self._view_size()
        size = [width, round(width * frame[1] / frame[0])]
        plotter: Any = pyvista.Plotter(off_screen=True, window_size=size)
        self._plotter = plotter
        self._plotter.render_window.SetMultiSamples(0)  # pictures are reduced in size afterwards
        self._plotter.set_background("white")
        self._set_camera(frame[1])
        self._skins = [_split(surface) for surface in self._parts.values()]
        shade = dict(ambient=0.35, diffuse=0.7, specular=0.15)
        colour = dict(scalars="motion", cmap=colours, clim=(0.0, 1.0), show_scalar_bar=False)
        widest = {name: part.shaft.largest_diameter for name, part in parts.items()}
        for name, skin in zip(parts, self._skins, strict=True):
            opacity = 1.0 if widest[name] == min(widest.values()) else THROUGH
            self._add(skin, **shade, **colour, opacity=opacity).prop.interpolation = "Phong"
        self._lines = _polylines(self._surface.points, self._surface.lines)
        _nearer(self._add(self._lines, color=EDGE, line_width=1.3, opacity=0.75), BESIDE)
        self._draw_at_rest(holders(spindle))
        self._axis = _rows(self._axis_at_rest)
        self._add_in_front(self._axis, "axis", color=AXIS, line_width=2.4)
        self._dots: Any = pyvista.PolyData(self._stations)
        self._dots.point_data["colour"] = np.zeros((len(self._stations), 3), np.uint8)
        dots = dict(scalars="colour", rgb=True, render_points_as_spheres=True, lighting=False)
        self._add_in_front(self._dots, "dots", point_size=14.0 * self._pixel, **dots)

    def show(self, node: Array, rotor: Sequence[str], shape: Complex) -> None:
        """Set the mode with node displacements ``shape`` (nodes, 6)."""
        spindle, mode = self._spindle, (node, rotor, shape)
        mode_motion = displacements(spindle, self._parts, *mode)
        size = reach(mode_motion)
        factor = drawn_scale(mode_motion, shape, self._reach)
        self._motion = factor * mode_motion
        for skin, part in self._by_skin(size / (size.max() or 1.0)):
            skin.point_data["motion"] = part
        self._centre = factor * section_motions(spindle, self._along, *mode)
        self._paths = factor * section_motions(spindle, self._orbits, *mode)
        whirl = np.array([turning(motion) for motion in self._paths])
        self._dots.point_data["colour"] = np.array([_rgb(TURNING[turn]) for turn in whirl])
        for turn, colour in TURNING.items():
            chosen = np.flatnonzero(whirl == turn)
            self._draw_orbits(self._stations[chosen], self._paths[chosen], turn, colour)

    def picture(self, phase: float) -> Pixels:
        """Render the mode at ``phase`` [rad] of its period, (height, width, 3)."""
        points = self._surface.points + at_phase(self._motion, phase)
        self._lines.points = points
        for skin, part in self._by_skin(points):
            skin.points = part
            skin.compute_normals(
                cell_normals=False, split_vertices=False, consistent_normals=False, inplace=True
            )
        self._axis.points = self._axis_at_rest + at_phase(self._centre[:, :3], phase)
        self._dots.points = self._stations + at_phase(self._paths[:, :3], phase)
        self._plotter.render()
        image = self._plotter.screenshot(None, return_img=True)
        return np.ascontiguousarray(image[:, :, :3])

    def close(self) -> None:
        """Close the window."""
        self._plotter.close()

    def _by_skin(self, values: Array) -> Iterator[tuple[Any, Array]]:
        """Yield every rotor's skin with the rows of ``values`` (all points) at its points."""
        ends = np.cumsum([len(surface.points) for surface in self._parts.values()])[:-1]
        for skin, part in zip(self._skins, np.split(values, ends), strict=True):
            yield skin, part[np.asarray(skin.point_data["origin"])]

    def _draw_at_rest(self, rings: Surface | None) -> None:
        """Draw what does not move: rings around the shaft, and the edges of the shaft at rest."""
        if rings is not None:
            self._add(_split(rings), color=HOLDER, opacity=0.22)
            self._add(_polylines(rings.points, _circles(rings)), color=HOLDER, line_width=1.5)
        edges = _polylines(self._surface.points, _circles(self._surface))
        self._add(edges, color=REST, line_width=1.2, opacity=0.6)
        self._add_in_front(_rows(self._axis_at_rest), "rest", color=REST, line_width=1.6)

    def _draw_orbits(self, at: Array, motions: Complex, turn: int, colour: str) -> None:
        """Draw orbits of the axis at ``at`` (n, 3), with an arrow where motion is most visible."""
        import pyvista

        name = f"orbits {turn}"
        for part in (name, f"{name} arrows"):
            self._plotter.remove_actor(part, reset_camera=False, render=False)
        if not len(at):
            return
        paths = [x + orbit(m, SMOOTH) for x, m in zip(at, motions, strict=True)]
        rows = np.arange(len(at) * SMOOTH).reshape(len(at), SMOOTH)
        closed = tuple(np.append(row, row[0]) for row in rows)
        mesh = _polylines(np.concatenate(paths), closed)
        self._add_in_front(mesh, name, color=colour, line_width=5.0)
        arrows = [head for path in paths for head in self._arrow(path)] if turn else []
        if arrows:
            self._add_in_front(
                pyvista.merge(arrows), f"{name} arrows", color=colour, lighting=False
            )

    def _arrow(self, path: Array) -> Iterator[Any]:
        """Yield an arrow head on ``path`` where it is fastest on the screen, unless too small."""
        import pyvista

        step = np.roll(path, -1, axis=0) - np.roll(path, 1, axis=0)
        length = np.linalg.norm(projected(step), axis=1)
        best, size = int(length.argmax()), 0.026 * self._length
        if np.ptp(path, axis=0).max() > size:
            yield pyvista.Cone(
                center=path[best],
                direction=step[best] / np.linalg.norm(step[best]),
                height=size,
                radius=0.34 * size,
                resolution=24,
            )

    def _add(self, mesh: Any, **look: Any) -> Any:
        if "line_width" in look:
            look["line_width"] *= self._pixel
        return self._plotter.add_mesh(mesh, reset_camera=False, render=False, **look)

    def _add_in_front(self, mesh: Any, name: str, **look: Any) -> None:
        """Draw ``mesh`` in front of everything, replacing what had the same name."""
        _nearer(self._add(mesh, name=name, **look), IN_FRONT)

    def _view_size(self) -> Array:
        """Return the least width and height [m] that hold the rotor with its largest motion."""
        spread = np.ptp(projected(self._surface.points), axis=0) + 1.9 * self._reach
        spread[1] = max(spread[1], 0.2 * spread[0])
        return np.asarray(1.02 * spread)

    def _set_camera(self, height: float) -> None:
        """Set a parallel projection that shows ``height`` [m]."""
        right, up, towards = screen()
        points = projected(self._surface.points)
        middle = (points.max(axis=0) + points.min(axis=0)) / 2.0
        target = right * middle[0] + up * middle[1]
        camera = self._plotter.camera
        camera.focal_point = tuple(target)
        camera.position = tuple(target + 10.0 * self._length * towards)
        camera.up = (0.0, 1.0, 0.0)
        camera.parallel_projection = True
        camera.parallel_scale = height / 2.0
        camera.clipping_range = (5.0 * self._length, 15.0 * self._length)


def _nearer(actor: Any, units: float) -> None:
    actor.mapper.SetResolveCoincidentTopologyToPolygonOffset()
    actor.mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0.0, units)
    actor.mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, units)
    actor.mapper.SetRelativeCoincidentTopologyPointOffsetParameter(units)


def _split(surface: Surface) -> Any:
    """Return the surface with points doubled along edges; ``origin``: index of the original."""
    import pyvista

    faces = np.insert(surface.triangles, 0, 3, axis=1)
    mesh: Any = pyvista.PolyData(surface.points, faces.ravel())
    mesh.point_data["origin"] = np.arange(len(surface.points))
    mesh.point_data["motion"] = np.zeros(len(surface.points))
    return mesh.compute_normals(
        cell_normals=False, split_vertices=True, feature_angle=SHARP, consistent_normals=False
    )


def _circles(surface: Surface) -> tuple[Indices, ...]:
    return tuple(line for line in surface.lines if line[0] == line[-1])


def _polylines(points: Array, lines: tuple[Indices, ...]) -> Any:
    import pyvista

    cells = [np.concatenate([[len(line)], line]) for line in lines]
    return pyvista.PolyData(points, lines=np.concatenate(cells))


def _rgb(colour: str) -> NDArray[np.uint8]:
    """Return ``#0072B2`` as three bytes."""
    return np.frombuffer(bytes.fromhex(colour.removeprefix("#")), np.uint8)


def _rows(points: Array) -> Any:
    """Return one line through every ``ALONG_AXIS`` of ``points``."""
    return _polylines(points, tuple(np.arange(len(points)).reshape(-1, ALONG_AXIS)))


def _on_axis(x: Array) -> Array:
    return np.stack([x, np.zeros_like(x), np.zeros_like(x)], axis=1)
