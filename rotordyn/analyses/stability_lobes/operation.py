"""The cut that a case asks for, at a speed: milling or turning, and its process damping."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.cutting import Cut, checked
from rotordyn.analyses.stability_lobes.forced import Forced
from rotordyn.analyses.stability_lobes.forces import Forces
from rotordyn.analyses.stability_lobes.modal_limit import Process
from rotordyn.analyses.stability_lobes.spec import StabilityLobesSpec
from rotordyn.analyses.stability_lobes.zero_order import Mean

Array = NDArray[np.float64]
ONE_WAY, BOTH_WAYS = 0.5, 1.0  # of a force that follows half of a swing alone, or all of it


@dataclass(frozen=True)
class Operation:
    """``spec``, its diameter known, with one pair of cutting coefficients [Pa]."""

    spec: StabilityLobesSpec
    tangential: float
    radial: float

    @property
    def cut(self) -> Cut:
        """The teeth in cut, of milling: without those that the run-out of a planned cut keeps
        out of it."""
        if self.spec.cut is None or not self.spec.cut.runout:
            return self._cutter
        cut = replace(self.planned.cut, lag=0.0)
        return cut.without(self.planned.idle)

    @property
    def _cutter(self) -> Cut:
        """All teeth."""
        own = self.spec
        edges = own.teeth, self.tangential, self.radial
        return checked(Cut(*edges, *own.ends, pitches=own.pitches))

    @property
    def diameter(self) -> float:
        """Of the cutter, or of the workpiece in turning [m]."""
        assert self.spec.diameter is not None, "the analysis takes it from the tool"
        return self.spec.diameter

    @property
    def divides(self) -> bool:
        """Whether coefficients divide the limits: not beside process damping, which does not grow
        with them, nor on helical edges, whose lag is that of the depth."""
        return self.spec.process_damping == 0.0 and self.spec.helix == 0.0

    def times(self, factor: float) -> Operation:
        """With coefficients of cutting ``factor`` times as large."""
        own, turning = self.spec, self.spec.turning
        if turning is not None:
            own = replace(own, turning=replace(turning, force=factor * turning.force))
        return Operation(own, factor * self.tangential, factor * self.radial)

    def delays(self, speed: Array) -> Array:
        """From one tooth to the next [s] at speeds [rad/s] (s, gaps); of turning a revolution."""
        gaps = (2.0 * math.pi,) if self.spec.turning else self.cut.gaps
        return np.array(gaps) / speed[:, None]

    def mean(self, speed: Array) -> Mean:
        """Mean of the forces by displacement (1 or s, 2, d) [Pa] and by velocity [N s/m²]; in
        turning d = 1, the motion in the feed."""
        rate = self.spec.process_damping / self._cutting_speed(speed)
        if self.spec.turning is None:
            own = self.cut
            rubbing = replace(own, tangential=0.0, radial=1.0).mean()
            return Mean(own.mean()[None], rate[:, None, None] * rubbing)
        # the force on the work by its motion towards the tool, in feed and normal
        angle, force = self.spec.turning.force_angle, self.spec.turning.force
        towards = np.array([[1.0], [0.0]])
        forced = np.array([[math.cos(angle)], [-math.sin(angle)]])
        return Mean(force * forced[None], rate[:, None, None] * towards)

    def process(self, speed: float) -> Process:
        """The cut at a speed [rad/s], of milling."""
        own, cut = self.spec, self.cut
        lag = 2.0 * math.tan(own.helix) / self.diameter
        period = cut.turn / speed
        if own.process_damping == 0.0:
            return Process(cut, period, lag)
        rate = own.process_damping / float(self._cutting_speed(np.array(speed)))
        return Process(cut, period, lag, replace(cut, tangential=0.0, radial=rate))

    def pushed(self, speed: float, share: float = ONE_WAY) -> Process:
        """The planned cut at a speed [rad/s] with a ``share`` of the edge forces that follow the
        vibration; one way: contact that it cuts short, not what would go on where older teeth have
        been."""
        own, planned, process = self.spec, self.spec.cut, self.process(speed)
        assert planned is not None
        feed = own.feed_per_tooth * own.teeth / (2.0 * math.pi)  # of a radian
        edges = share * planned.tangential_edge / feed, share * planned.radial_edge / feed
        return process._replace(cut=replace(process.cut, edges=edges))

    @property
    def planned(self) -> Forces:
        """Forces of the planned cut."""
        own, planned = self.spec, self.spec.cut
        assert planned is not None
        lag = 2.0 * planned.depth * math.tan(own.helix) / self.diameter
        edges = planned.tangential_edge, planned.radial_edge
        cut = replace(self._cutter, lag=lag, runout=planned.runout)
        return Forces(cut, planned.depth, own.feed_per_tooth, *edges)

    def forced(self, speed: float, top: float) -> Forced:
        """The planned cut at a speed [rad/s], its harmonics up to ``top`` [rad/s]."""
        rubbing = self.spec.process_damping / float(self._cutting_speed(np.array(speed)))
        return Forced(self.planned, self.diameter, speed, top, rubbing)

    def torque(self, depth: float = 1.0) -> float:
        """Mean torque of a stable cut of some depth [m], with edge forces and run-out of the
        planned one [N m]: in proportion to the depth."""
        own = self.spec
        if own.turning is not None:
            tangential = own.turning.force * math.sin(own.turning.force_angle)
            return 0.5 * self.diameter * depth * tangential * own.feed_per_tooth
        forces = Forces(self.cut, depth, own.feed_per_tooth)
        if own.cut is not None:
            forces = replace(self.planned, depth=depth)
        return 0.5 * self.diameter * forces.mean_torque()

    def removal(self, speed: Array, depth: Array | float) -> Array:
        """Removal rate of a depth [m³/s]."""
        own = self.spec
        if own.turning is None:
            width = own.immersion * self.diameter
            return depth * width * own.feed_per_tooth * own.teeth * speed / (2.0 * math.pi)
        return depth * own.feed_per_tooth * self._cutting_speed(speed)

    def _cutting_speed(self, speed: Array) -> Array:
        """[m/s]"""
        return 0.5 * self.diameter * speed
