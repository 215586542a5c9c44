"""How a shaft deforms under its section forces: strain integrated from the front end on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.machine.cross_section import area, second_moment
from rotordyn.machine.spindle import Spindle
from rotordyn.model.mesh import Mesh
from rotordyn.model.section_forces import SectionForces
from rotordyn.model.shaft import shear_coefficients

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class Compliance:
    """1/EA, 1/κGA [1/N], 1/EI, 1/GIp [1/(N·m²)] of every element (elements,)."""

    stretch: Array
    shear: Array
    bending: Array
    torsion: Array


def compliance(spindle: Spindle, mesh: Mesh, *, rigid: bool) -> Compliance:
    """Of a Timoshenko shaft; zero where the rotor is ``rigid``."""
    ring = mesh.outer_diameter, mesh.inner_diameter
    own = 0.0 if rigid else 1.0
    shear = shear_coefficients(spindle, mesh) * mesh.shear_modulus
    return Compliance(
        stretch=own / (mesh.young_modulus * area(*ring)),
        shear=own / (shear * area(*ring)),
        bending=own / (mesh.young_modulus * second_moment(*ring)),
        torsion=own / (2.0 * mesh.shear_modulus * second_moment(*ring)),
    )


def elastic_line(x: Array, give: Compliance, forces: SectionForces, line: Array) -> Array:
    """Displacement (…, nodes, 6) of nodes at ``x`` [m] with the front end held; exact.

    ``line`` (…, elements, 3): the line loads [N/m] that are part of ``forces``.
    """
    h = np.diff(x)
    qx, qy, qz = np.moveaxis(line, -1, 0)
    n, ty, tz, mt, my, mz = np.moveaxis(forces.rear, -1, 0)
    turn_y = give.bending * (my * h - tz * h**2 / 2.0 - qz * h**3 / 6.0)
    turn_z = give.bending * (mz * h + ty * h**2 / 2.0 + qy * h**3 / 6.0)
    thy, thz = _from_front(turn_y), _from_front(turn_z)
    bend_y = give.bending * (mz * h**2 / 2.0 + ty * h**3 / 3.0 + qy * h**4 / 8.0)
    bend_z = give.bending * (my * h**2 / 2.0 - tz * h**3 / 3.0 - qz * h**4 / 8.0)
    y = h * thz[..., :-1] + bend_y + give.shear * (ty * h + qy * h**2 / 2.0)
    z = -h * thy[..., :-1] - bend_z + give.shear * (tz * h + qz * h**2 / 2.0)
    stretch = give.stretch * (n * h + qx * h**2 / 2.0)
    columns = (_from_front(stretch), _from_front(y), _from_front(z))
    return np.stack([*columns, _from_front(give.torsion * mt * h), thy, thz], axis=-1)


def _from_front(change: Array) -> Array:
    """Values at the nodes (…, nodes) from changes over the elements, 0 at the front."""
    return np.concatenate([np.zeros_like(change[..., :1]), np.cumsum(change, axis=-1)], axis=-1)
