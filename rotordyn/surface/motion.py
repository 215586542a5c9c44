"""Motion of the points of a surface in a mode: cross-sections stay plane and rigid."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array, Complex
from rotordyn.equation.elements.beam import shear_parameter
from rotordyn.equation.elements.shear import shear_coefficient
from rotordyn.machine.cross_section import area, second_moment
from rotordyn.machine.shaft import Shaft
from rotordyn.surface.body import Surface
from rotordyn.surface.interpolation import between_nodes

STEEPEST = 0.35  # rad: tilt of a drawn cross-section, which grows by 1 / cos of it


def section_motion(shaft: Shaft, node: Array, shape: Complex, station: Array) -> Complex:
    """Return the six displacements of the cross-sections at ``station``, shape (len(station), 6).

    ``shape`` (nodes, 6): those of the nodes at ``node`` [m]; between them the shaft bends as an
    unloaded element of constant section.
    """
    return between_nodes(node, shape, _shear_parameters(shaft, node), station)


def displacement(surface: Surface, shaft: Shaft, node: Array, shape: Complex) -> Complex:
    """Return the complex displacement of every point of ``surface``, shape (n, 3), for small tilts.

    u + θ × r with r from the axis at the point's station; at phase τ of a period the motion is
    Re(u e^(iτ)).
    """
    stations, back = np.unique(surface.station, return_inverse=True)
    motion = section_motion(shaft, node, shape, stations)[back.reshape(-1)]
    arm = surface.points - surface.station[:, None] * np.array([1.0, 0.0, 0.0])
    return np.asarray(motion[:, :3] + np.cross(motion[:, 3:], arm))


def reach(displacement: Complex) -> Array:
    """Return the largest distance from rest over a period, (n,): the ellipse's semi-major axis.

    It is √((|u|² + |u·u|) / 2) for complex displacements u (n, 3).
    """
    square = (np.abs(displacement) ** 2).sum(axis=-1)
    return np.sqrt((square + np.abs((displacement**2).sum(axis=-1))) / 2.0)


def drawn_scale(displacement: Complex, shape: Complex, length: float) -> float:
    """Return the factor by which the largest ``reach`` becomes ``length`` [m], less where tilts
    would not be small: none of ``shape`` (nodes, 6) exceeds ``STEEPEST``. 1 where nothing moves."""
    largest = float(reach(displacement).max())
    tilt = float(reach(shape[:, 3:]).max())
    limits = [length / largest] if largest > 0.0 else []
    limits += [STEEPEST / tilt] if tilt > 0.0 else []
    return min(limits, default=1.0)


def at_phase(displacement: Complex, phase: float) -> Array:
    """Return the displacement at ``phase`` [rad] of a period."""
    return np.asarray((displacement * np.exp(1j * phase)).real)


def _shear_parameters(shaft: Shaft, node: Array) -> Array:
    middle = (node[1:] + node[:-1]) / 2.0
    sections = shaft.sections_at(middle)
    outer, inner = np.array([shaft.diameters_at(x) for x in middle]).T
    young = np.array([s.material.young_modulus for s in sections])
    poisson = np.array([s.material.poisson_ratio for s in sections])
    kappa = shear_coefficient(shaft.shear_coefficient, poisson, inner / outer)
    shear = kappa * young / (2.0 * (1.0 + poisson)) * area(outer, inner)
    return shear_parameter(np.diff(node), young * second_moment(outer, inner), shear)
