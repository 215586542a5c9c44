"""Oil film between balls and races: thickness, its ratio to the roughness, its stiffness.

Hamrock and Dowson's formulas of a fully flooded, isothermal elliptic contact; inlet heating after
Gupta (1992). Both are from memory [M].
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from bearings.arguments import checked, one_each
from bearings.arrays import Array
from bearings.errors import InvalidBearing, shown
from bearings.ring.motion import contact_motion

if TYPE_CHECKING:
    from bearings.lubricant import Lubricant
    from bearings.ring.state import BearingState

_BY_LOAD = 0.067  # exponent of the load in the central film thickness


@dataclass(frozen=True, eq=False)
class Film:
    """Films of a state, by contact (…, balls, contacts); NaN where there is no state.

    ``least``, ``central``: thicknesses h_min and h_c [m], with inlet heating, 0 without load or
    speed; ``heating``: φT, the factor of inlet heating, 0 where its formula has no value;
    ``stiffness``: dQ/dh at constant speed [N/m], in series with that of the contact. ``growth``
    (…, balls) [m]: apparent growth of a ball by its films, hi + ho of the most loaded contact
    of each race; with four contacts a ball grows along both its diagonals.
    """

    least: Array
    central: Array
    heating: Array
    stiffness: Array
    growth: Array

    def ratio(self, ball_roughness: float, race_roughness: float) -> Array:
        """Λ = h_min over the root of both squared roughnesses Rq [m]."""
        return np.asarray(self.least / np.hypot(ball_roughness, race_roughness))


@checked
def hamrock_dowson(
    load: ArrayLike,
    entrainment: ArrayLike,
    radius: ArrayLike,
    modulus: float,
    ellipticity: ArrayLike,
    viscosity: ArrayLike,
    pressure_viscosity: float,
) -> tuple[Array, Array]:
    """h_min and h_c of an elliptic contact [m], fully flooded and isothermal.

    ``load`` [N]; ``entrainment`` u [m/s]: mean velocity of both surfaces; ``radius`` Rx [m]: of the
    equivalent ball along rolling; ``modulus`` E' [Pa]: 2/Σ((1 − ν²)/E), twice the reduced one;
    ``ellipticity``: a/b, a across rolling; ``viscosity`` η [Pa·s]; ``pressure_viscosity`` [1/Pa].
    """
    q, u, rx = (np.asarray(value, float) for value in (load, entrainment, radius))
    k, eta = np.asarray(ellipticity, float), np.asarray(viscosity, float)
    loaded = q > 0.0
    speed, material = eta * u / (modulus * rx), pressure_viscosity * modulus
    weight = np.where(loaded, q, 1.0) / (modulus * rx**2)
    least = 3.63 * rx * speed**0.68 * material**0.49 * weight**-0.073 * -np.expm1(-0.68 * k)
    central = 2.69 * rx * speed**0.67 * material**0.53 * weight**-_BY_LOAD
    central = central * (1.0 - 0.61 * np.exp(-0.73 * k))
    return np.where(loaded, least, 0.0), np.where(loaded, central, 0.0)


@checked
def inlet_heating(
    pressure: ArrayLike, modulus: float, loading: ArrayLike, slip: ArrayLike = 0.0
) -> Array:
    """Factor φT of inlet heating on the film thickness, Gupta (1992); 0 beyond the range of the
    formula, which ends at 13.2 (p/E') L^0.42 = 1.

    ``pressure``: peak [Pa]; ``loading`` L = η β u²/k; ``slip`` S: sliding over entrainment.
    """
    p, heat, s = (np.asarray(value, float) for value in (pressure, loading, slip))
    top = 1.0 - 13.2 * (p / modulus) * heat**0.42
    return np.asarray(np.maximum(top, 0.0) / (1.0 + 0.213 * (1.0 + 2.23 * s**0.83) * heat**0.64))


@checked
def film(
    state: BearingState,
    lubricant: Lubricant,
    temperature: ArrayLike,
    *,
    starvation: float = 1.0,
    heating: bool = True,
) -> Film:
    """Films of the contacts of a state.

    Parameters
    ----------
    temperature : of the oil at the inlet, shape (…) [°C]
    starvation : factor on both thicknesses, 1 fully flooded
    heating : with inlet heating, of pure rolling (S = 0)

    Raises
    ------
    InvalidBearing : a starvation that is 0 or less, or above 1; temperatures that are not one for
        all states, or one each
    """
    temperature = one_each(temperature, state.outcome.shape, "temperature")
    if not 0.0 < starvation <= 1.0:
        raise InvalidBearing(f"starvation must lie above 0 up to 1, got {shown(starvation)}")
    g, grooves = state.operation.geometry, state.operation.grooves
    compliance = grooves.ball_material.contact_compliance + grooves.ring_material.contact_compliance
    modulus = 2.0 / compliance
    side = g.by_contact(1.0, -1.0)
    load = np.asarray(state.contact_load)
    angle = np.nan_to_num(np.asarray(state.contact_angle))
    radius = 0.5 * g.ball_diameter * (1.0 - side * g.size_ratio * np.cos(angle))
    kappa = g.by_contact(g.inner.ellipticity, g.outer.ellipticity)
    celsius = temperature[..., None, None]
    eta = lubricant.dynamic(celsius)
    speed = np.asarray(state.speed)[..., None, None]
    u = np.nan_to_num(contact_motion(state).entrainment) * speed
    least, central = hamrock_dowson(
        load, u, radius, modulus, kappa, eta, lubricant.pressure_viscosity
    )
    factor = np.ones_like(least)
    if heating:
        parameter = eta * lubricant.thinning(celsius) * u**2 / lubricant.conductivity
        factor = inlet_heating(state.contact_pressure, modulus, parameter)
    exists = (np.asarray(state.outcome) == "")[..., None, None]
    least, central = (
        np.where(exists, thickness * factor * starvation, np.nan) for thickness in (least, central)
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        stiffness = np.where(central > 0.0, load / (_BY_LOAD * central), np.inf)
    inner, outer = (_heaviest(load[..., race], central[..., race]) for race in g.races)
    return Film(least, central, factor, stiffness, inner + outer)


def _heaviest(load: Array, thickness: Array) -> Array:
    """Film thickness (…, balls) of the most loaded contact of a race (…, balls, contacts)."""
    index = load.argmax(axis=-1, keepdims=True)
    return np.take_along_axis(thickness, index, axis=-1)[..., 0]
