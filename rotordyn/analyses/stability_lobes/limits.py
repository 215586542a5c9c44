"""Stability limits at many speeds, each with the receptance of the tip at that speed."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from rotordyn.analyses.stability_lobes.limit import sampled_limit
from rotordyn.analyses.stability_lobes.measured_tip import MeasuredTip
from rotordyn.analyses.stability_lobes.modal import Change
from rotordyn.analyses.stability_lobes.modal_limit import Limit, Process, modal_limit
from rotordyn.analyses.stability_lobes.operation import Operation
from rotordyn.analyses.stability_lobes.sampling import TURN, refuse_slow
from rotordyn.analyses.stability_lobes.spec import FLIP, HOPF, NONE, WITHOUT_CUT, ZERO_ORDER
from rotordyn.analyses.stability_lobes.tip import Tip
from rotordyn.analyses.stability_lobes.zero_order import zero_order
from rotordyn.arrays import Array, Complex, Flags, Indices
from rotordyn.errors import InvalidInput
from rotordyn.numerics.threads import each_in_threads

Rows = Indices
MOST_SAMPLES = 4000  # at a speed, of costly receptances; splines interpolate between them
AT_ONCE = 1_000_000  # samples of all speeds solved together
PARTS = 20  # number of progress reports
TOGETHER = 1.4  # largest ratio of the periods of speeds that share samples
NOT_MODES = (
    "stability_lobes: with a loss factor, or with rigid-body modes, the receptance is not a "
    "sum of modes: {what}"
)


@dataclass(frozen=True)
class Limits:
    """Limits of ``tip`` at ``rows`` of its speeds, each with the cutter at ``speed`` [rad/s]."""

    tip: Tip | MeasuredTip
    rows: Rows
    speed: Array
    progress: Callable[[str], None] = lambda _: None

    def changed(self, rows: Rows, change: Change) -> Limits:
        """Return the limits at some of the speeds of a machine with stiffness and damping scaled.

        Raises
        ------
        InvalidInput : a receptance that is no sum of modes
        """
        assert isinstance(self.tip, Tip)
        if self.tip.modes is None:
            raise InvalidInput(NOT_MODES.format(what="leave interval out"))
        tip = self.tip.changed(self.rows[rows], change)
        return Limits(tip, np.arange(len(rows)), self.speed[rows], self.progress)

    def of(self, operation: Operation) -> list[Limit]:
        """Return the limits of an operation, 0 where the machine is unstable without a cut.

        Raises
        ------
        InvalidInput : process damping of a machine whose receptance is no sum of modes
        """
        growing = self.tip.growing[self.rows]
        limits = [Limit(0.0, pole.imag / (2.0 * math.pi), WITHOUT_CUT) for pole in growing.tolist()]
        stable_rows = np.flatnonzero(growing == 0.0)
        if stable_rows.size:
            stable = replace(self, rows=self.rows[stable_rows], speed=self.speed[stable_rows])
            for row, limit in zip(
                stable_rows.tolist(), stable._stable_limits(operation), strict=True
            ):
                limits[row] = limit
        return limits

    def _stable_limits(self, operation: Operation) -> list[Limit]:
        """Return the limits of an operation of a machine that is stable without a cut."""
        spec = operation.spec
        if spec.method == ZERO_ORDER or spec.turning is not None:
            return self._zero_order_limits(operation)
        if isinstance(self.tip, Tip) and self.tip.modes is None:
            return self._sampled_limits(self.tip, operation)
        assert self.tip.modes is not None
        tops = self.tip.tops[self.rows]
        tips = [self.tip.modes.at(row) for row in self.rows.tolist()]
        processes = map(operation.process, self.speed.tolist())
        arguments = [*zip(tips, tops.tolist(), processes, strict=True)]
        # numpy leaves the interpreter free while it solves for eigenvalues
        return self._reported(each_in_threads(lambda values: modal_limit(*values), arguments))

    def stable(self, process: Callable[[float], Process], depth: Array, kind: str = NONE) -> Flags:
        """Return whether cuts are stable at a ``depth`` (s,) [m], of machines that are stable
        without a cut; with ``kind`` ``FLIP``, whether no period doubling occurs.

        Raises
        ------
        InvalidInput : see ``sampled_limit``
        """
        tops = self.tip.tops[self.rows]

        def radius(row: int, top: float, cut: Process, depth: float) -> float:
            if isinstance(self.tip, Tip) and self.tip.modes is None:
                limit = self._sampled_limit(self.tip, row, cut)
                if kind == FLIP and limit.kind != FLIP:
                    return 0.0
                return depth / limit.depth
            assert self.tip.modes is not None
            values = cut.floquet(self.tip.modes.at(row), top, depth).multipliers(depth)
            if kind == FLIP:
                values = values[(values.imag == 0.0) & (values.real < 0.0)]
            return float(np.abs(values).max(initial=0.0))

        cuts = map(process, self.speed.tolist())
        arguments = zip(self.rows.tolist(), tops.tolist(), cuts, depth.tolist(), strict=True)
        radii = [*each_in_threads(lambda values: radius(*values), [*arguments])]
        return np.array(radii) < 1.0

    def _reported(self, solved: Iterator[Limit]) -> list[Limit]:
        """Collect limits as they are solved, reporting progress in parts."""
        limits, count = [], len(self.rows)
        for limit in solved:
            limits.append(limit)
            if len(limits) % max(1, count // PARTS) == 0:
                self.progress(f"{len(limits)} of {count} speeds")
        return limits

    def _sampled_limits(self, tip: Tip, operation: Operation) -> list[Limit]:
        """Return limits with a receptance that is no sum of modes."""
        if operation.spec.process_damping > 0.0:
            what = "leave process_damping and interval out, or take method: zero-order"
            raise InvalidInput(NOT_MODES.format(what=what))

        def limit(row: int, speed: float) -> Limit:
            return self._sampled_limit(tip, row, operation.process(speed))

        tip.tops  # noqa: B018  solved once, before threads ask for it
        arguments = [*zip(self.rows.tolist(), self.speed.tolist(), strict=True)]
        return self._reported(each_in_threads(lambda values: limit(*values), arguments))

    def _sampled_limit(self, tip: Tip, row: int, process: Process) -> Limit:
        tip_at_row = tip.at(row)
        near, top = tip.about_poles(row), float(tip.tops[row])
        return sampled_limit(lambda w: tip_at_row.receptance(w[None])[0], near, top, process)

    def _zero_order_limits(self, operation: Operation) -> list[Limit]:
        """Return zero-order limits, solved together for speeds with similar tooth periods."""
        delays = operation.delays(self.speed)
        period = delays.max(axis=1)
        limits: list[Limit] = []
        most = float(self.tip.tops.max()) / TURN  # samples in a second
        for part in _similar_periods(period, AT_ONCE / most):
            omega = self._samples(self.rows[part], period[part])
            mean = operation.mean(self.speed[part])
            directions, top = mean.cutting.shape[-1], float(omega[:, -1].max())
            receptance = self._receptance(self.rows[part], top, directions)
            sampled = receptance
            if self.tip.modes is None:
                coarse = self._samples(self.rows[part], period[part], MOST_SAMPLES)
                sampled = partial(_interpolated, receptance, coarse)
            depth, at = zero_order(receptance, mean, delays[part], omega, sampled)
            limits += [
                Limit(float(a), float(w) / (2.0 * math.pi), HOPF if math.isfinite(a) else NONE)
                for a, w in zip(depth, at, strict=True)
            ]
        return limits

    def _samples(self, rows: Rows, period: Array, most: float = math.inf) -> Array:
        """Return frequencies (s, f), ascending: some resolve the peaks, evenly spaced ones resolve
        the phase from tooth to tooth unless that takes more than ``most``."""
        near = [self.tip.about_poles(row) for row in rows.tolist()]
        tops = self.tip.tops[rows]
        refuse_slow(float(tops.max()), float(period.max()))
        even = int(min(math.ceil(float((tops * period).max()) / TURN), most))
        longest = max(map(len, near))
        omega = np.empty((len(rows), even + longest))
        omega[:, :even] = tops[:, None] * (np.arange(1, even + 1) / even)
        for k, peak_samples in enumerate(near):
            at = np.linspace(0, len(peak_samples) - 1, longest)
            omega[k, even:] = np.interp(at, np.arange(len(peak_samples)), peak_samples)
        omega.sort(axis=1)
        return omega

    def _receptance(self, rows: Rows, top: float, directions: int) -> Callable[[Array], Complex]:
        """Return receptance (s, f, directions, 2) as a function of ω (s, f) to ``top`` [rad/s]."""
        modes = self.tip.modes
        if modes is not None:
            return modes.of(rows, top, directions).receptance
        assert isinstance(self.tip, Tip)
        return partial(_receptance_at_rows, self.tip, rows, directions)


def _receptance_at_rows(tip: Tip, rows: Rows, directions: int, omega: Array) -> Complex:
    """Return the receptance at some rows; the tip takes frequencies at all of its speeds."""
    if tip.count == 1:
        flat = tip.receptance(omega.reshape(1, -1))
        return flat.reshape(*omega.shape, 2, 2)[..., :directions, :]
    all_omega = np.ones((tip.count, omega.shape[1]))
    all_omega[rows] = omega
    return tip.receptance(all_omega)[rows][..., :directions, :]


def _interpolated(receptance: Callable[[Array], Complex], known: Array, omega: Array) -> Complex:
    """Return the receptance at ``omega`` (s, f) by cubic splines through its values at ``known``
    (s, k), where these are fewer."""
    if known.shape == omega.shape:
        return receptance(omega)
    from scipy.interpolate import CubicSpline

    splined = []
    for at, values, wanted in zip(known, receptance(known), omega, strict=True):
        distinct, first = np.unique(at, return_index=True)
        splined.append(CubicSpline(distinct, values[first])(wanted))
    return np.stack(splined)


def _similar_periods(period: Array, most: float) -> Iterator[slice]:
    """Yield runs of speeds whose periods have ratios up to ``TOGETHER``, with the number of speeds
    times the longest period up to ``most`` [s]; periods descend."""
    first = 0
    for k in range(1, len(period) + 1):
        too_long = (k - first + 1) * period[first] > most
        if k == len(period) or too_long or period[first] > TOGETHER * period[k]:
            yield slice(first, k)
            first = k
