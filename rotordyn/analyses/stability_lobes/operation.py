"""Cut of a case at a speed: milling or turning, and its process damping."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from rotordyn.analyses.stability_lobes.cutting import Cut, checked
from rotordyn.analyses.stability_lobes.forced import Forced
from rotordyn.analyses.stability_lobes.forces import Forces
from rotordyn.analyses.stability_lobes.modal_limit import Process
from rotordyn.analyses.stability_lobes.spec import StabilityLobesSpec
from rotordyn.analyses.stability_lobes.zero_order import Mean
from rotordyn.arrays import Array

ONE_WAY, BOTH_WAYS = 0.5, 1.0  # of a force that follows one half-cycle of vibration, or both


@dataclass(frozen=True)
class Operation:
    """Operation of a ``spec`` with a diameter, and one pair of cutting coefficients [Pa]."""

    spec: StabilityLobesSpec
    tangential: float
    radial: float

    @property
    def cut(self) -> Cut:
        """Milling cut, without the teeth that, by the run-out of a planned cut, do not cut."""
        if self.spec.cut is None or not self.spec.cut.runout:
            return self._cutter
        cut = replace(self.planned.cut, lag=0.0)
        return cut.without(self.planned.idle)

    @property
    def _cutter(self) -> Cut:
        """Cut of all teeth."""
        spec = self.spec
        edges = spec.teeth, self.tangential, self.radial
        return checked(Cut(*edges, *spec.ends, pitches=spec.pitches))

    @property
    def diameter(self) -> float:
        """Diameter of the cutter, or of the workpiece in turning [m]."""
        assert self.spec.diameter is not None, "the analysis takes it from the tool"
        return self.spec.diameter

    @property
    def divides(self) -> bool:
        """Whether limits are inversely proportional to the coefficients: not with process damping,
        which does not grow with them, nor with helical edges, whose lag grows with depth."""
        return self.spec.process_damping == 0.0 and self.spec.helix == 0.0

    def times(self, factor: float) -> Operation:
        """Return the operation with cutting coefficients times ``factor``."""
        spec, turning = self.spec, self.spec.turning
        if turning is not None:
            spec = replace(spec, turning=replace(turning, force=factor * turning.force))
        return Operation(spec, factor * self.tangential, factor * self.radial)

    def delays(self, speed: Array) -> Array:
        """Return delays between teeth (s, gaps) [s] at speeds [rad/s]; turning: a revolution."""
        gaps = (2.0 * math.pi,) if self.spec.turning else self.cut.gaps
        return np.array(gaps) / speed[:, None]

    def mean(self, speed: Array) -> Mean:
        """Return mean forces by displacement (1 or s, 2, d) [Pa] and by velocity [N s/m²]; in
        turning d = 1, the motion in the feed."""
        rate = self.spec.process_damping / self._cutting_speed(speed)
        if self.spec.turning is None:
            cut = self.cut
            rubbing = replace(cut, tangential=0.0, radial=1.0).mean()
            return Mean(cut.mean()[None], rate[:, None, None] * rubbing)
        # the force on the work by its motion towards the tool, in feed and normal
        angle, force = self.spec.turning.force_angle, self.spec.turning.force
        towards = np.array([[1.0], [0.0]])
        forced = np.array([[math.cos(angle)], [-math.sin(angle)]])
        return Mean(force * forced[None], rate[:, None, None] * towards)

    def process(self, speed: float) -> Process:
        """Return the milling process at a speed [rad/s]."""
        spec, cut = self.spec, self.cut
        lag = 2.0 * math.tan(spec.helix) / self.diameter
        period = cut.turn / speed
        if spec.process_damping == 0.0:
            return Process(cut, period, lag)
        rate = spec.process_damping / float(self._cutting_speed(np.array(speed)))
        return Process(cut, period, lag, replace(cut, tangential=0.0, radial=rate))

    def pushed(self, speed: float, share: float = ONE_WAY) -> Process:
        """Return the planned cut at a speed [rad/s] with a ``share`` of the edge forces that follow
        the vibration; one way: vibration shortens contact, but does not prolong it over surfaces
        that earlier teeth have cut."""
        spec, planned, process = self.spec, self.spec.cut, self.process(speed)
        assert planned is not None
        feed = spec.feed_per_tooth * spec.teeth / (2.0 * math.pi)  # of a radian
        edges = share * planned.tangential_edge / feed, share * planned.radial_edge / feed
        return process._replace(cut=replace(process.cut, edges=edges))

    @property
    def planned(self) -> Forces:
        """Forces of the planned cut."""
        spec, planned = self.spec, self.spec.cut
        assert planned is not None
        lag = 2.0 * planned.depth * math.tan(spec.helix) / self.diameter
        edges = planned.tangential_edge, planned.radial_edge
        cut = replace(self._cutter, lag=lag, runout=planned.runout)
        return Forces(cut, planned.depth, spec.feed_per_tooth, *edges)

    def forced(self, speed: float, top: float) -> Forced:
        """Return the planned cut at a speed [rad/s], with harmonics up to ``top`` [rad/s]."""
        rubbing = self.spec.process_damping / float(self._cutting_speed(np.array(speed)))
        return Forced(self.planned, self.diameter, speed, top, rubbing)

    def torque(self, depth: float = 1.0) -> float:
        """Return the mean torque [N m] of a stable cut of some depth [m], with edge forces and
        run-out of the planned one; it is proportional to depth."""
        spec = self.spec
        if spec.turning is not None:
            tangential = spec.turning.force * math.sin(spec.turning.force_angle)
            return 0.5 * self.diameter * depth * tangential * spec.feed_per_tooth
        forces = Forces(self.cut, depth, spec.feed_per_tooth)
        if spec.cut is not None:
            forces = replace(self.planned, depth=depth)
        return 0.5 * self.diameter * forces.mean_torque()

    def removal(self, speed: Array, depth: Array | float) -> Array:
        """Return the removal rate [m³/s] of a depth [m]."""
        spec = self.spec
        if spec.turning is None:
            width = spec.immersion * self.diameter
            return depth * width * spec.feed_per_tooth * spec.teeth * speed / (2.0 * math.pi)
        return depth * spec.feed_per_tooth * self._cutting_speed(speed)

    def _cutting_speed(self, speed: Array) -> Array:
        """Return the cutting speed [m/s]."""
        return 0.5 * self.diameter * speed
