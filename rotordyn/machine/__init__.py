"""What the machine is: frozen descriptions in SI units, no matrices, no files."""

from __future__ import annotations

from rotordyn.machine.ball_guide import BallGuide as BallGuide
from rotordyn.machine.bearing_set import BearingSet as BearingSet
from rotordyn.machine.bearing_set import SetPreload as SetPreload
from rotordyn.machine.drawbar import Drawbar as Drawbar
from rotordyn.machine.fits import Fits as Fits
from rotordyn.machine.flexible_rings import RingBodies as RingBodies
from rotordyn.machine.growth import ComputedShortening as ComputedShortening
from rotordyn.machine.growth import InterferenceFit as InterferenceFit
from rotordyn.machine.growth import PrescribedShortening as PrescribedShortening
from rotordyn.machine.growth import QuadraticInSpeed as QuadraticInSpeed
from rotordyn.machine.growth import RingGrowth as RingGrowth
from rotordyn.machine.history import HistoryStep as HistoryStep
from rotordyn.machine.housing import ReducedHousing as ReducedHousing
from rotordyn.machine.housing import RigidHousing as RigidHousing
from rotordyn.machine.joint import Joint as Joint
from rotordyn.machine.lumped import Disc as Disc
from rotordyn.machine.lumped import PointMass as PointMass
from rotordyn.machine.motor import Motor as Motor
from rotordyn.machine.reference import Reference as Reference
from rotordyn.machine.rotor import RayleighDamping as RayleighDamping
from rotordyn.machine.rotor import Rotor as Rotor
from rotordyn.machine.seat import BearingSeat as BearingSeat
from rotordyn.machine.seat import Misalignment as Misalignment
from rotordyn.machine.shaft import Section as Section
from rotordyn.machine.shaft import Shaft as Shaft
from rotordyn.machine.sleeve import Sleeve as Sleeve
from rotordyn.machine.sleeve import Spring as Spring
from rotordyn.machine.spindle import Spindle as Spindle
from rotordyn.machine.squeeze_film import SqueezeFilmDamper as SqueezeFilmDamper
from rotordyn.machine.support import LinearSupport as LinearSupport
from rotordyn.machine.temperatures import BearingTemperatures as BearingTemperatures
from rotordyn.machine.temperatures import Temperatures as Temperatures
from rotordyn.machine.tool import Tool as Tool

__all__ = sorted(name for name in globals() if name[0].isupper())  # noqa: PLE0605 - those above


def __dir__() -> list[str]:
    return list(__all__)
