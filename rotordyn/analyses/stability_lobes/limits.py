"""Limits at many speeds, each with the receptance of the tip at that speed."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.limit import sampled_limit
from rotordyn.analyses.stability_lobes.measured_tip import MeasuredTip
from rotordyn.analyses.stability_lobes.modal import Change
from rotordyn.analyses.stability_lobes.modal_limit import Limit, Process, modal_limit
from rotordyn.analyses.stability_lobes.operation import Operation
from rotordyn.analyses.stability_lobes.sampling import TURN, refuse_slow
from rotordyn.analyses.stability_lobes.spec import FLIP, HOPF, NONE, WITHOUT_CUT, ZERO_ORDER
from rotordyn.analyses.stability_lobes.tip import Tip
from rotordyn.analyses.stability_lobes.zero_order import zero_order
from rotordyn.errors import InvalidInput
from rotordyn.numerics.threads import each_in_threads

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Rows = NDArray[np.intp]
Flags = NDArray[np.bool_]
MOST_SAMPLES = 4000  # of a speed, of receptances that take long; between them by splines
AT_ONCE = 1_000_000  # samples of all speeds that are solved together
PARTS = 20  # in which progress is reported
TOGETHER = 1.4  # ratio of the periods of speeds that are sampled alike
NOT_MODES = (
    "stability_lobes: with a loss factor, or with motions that nothing holds, the receptance is no "
    "sum of modes: {what}"
)


@dataclass(frozen=True)
class Limits:
    """Limits of ``tip`` at ``rows`` of its speeds, the cutter at ``speed`` [rad/s] each."""

    tip: Tip | MeasuredTip
    rows: Rows
    speed: Array
    progress: Callable[[str], None] = lambda _: None

    def changed(self, rows: Rows, change: Change) -> Limits:
        """The same at some of the speeds, of a machine that is changed as a whole.

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
        """The limits of an operation, 0 where the machine is unstable by itself.

        Raises
        ------
        InvalidInput : process damping of a machine whose receptance is no sum of modes
        """
        own = self.tip.growing[self.rows]
        found = [Limit(0.0, pole.imag / (2.0 * math.pi), WITHOUT_CUT) for pole in own.tolist()]
        rest = np.flatnonzero(own == 0.0)
        if rest.size:
            stable = replace(self, rows=self.rows[rest], speed=self.speed[rest])
            for row, limit in zip(rest.tolist(), stable._cut(operation), strict=True):
                found[row] = limit
        return found

    def _cut(self, operation: Operation) -> list[Limit]:
        """The same of a machine that is stable by itself."""
        spec = operation.spec
        if spec.method == ZERO_ORDER or spec.turning is not None:
            return self._mean(operation)
        if isinstance(self.tip, Tip) and self.tip.modes is None:
            return self._sampled(self.tip, operation)
        assert self.tip.modes is not None
        tops = self.tip.tops[self.rows]
        tips = [self.tip.modes.at(row) for row in self.rows.tolist()]
        processes = map(operation.process, self.speed.tolist())
        every = [*zip(tips, tops.tolist(), processes, strict=True)]
        # numpy leaves the interpreter free while it solves for eigenvalues
        return self._reported(each_in_threads(lambda one: modal_limit(*one), every))

    def stable(self, process: Callable[[float], Process], depth: Array, kind: str = NONE) -> Flags:
        """Whether cuts by speed are stable at a ``depth`` (s,) [m], of machines that are stable
        without a cut; of the ``kind`` ``FLIP`` whether no period doubles.

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
            found = cut.floquet(self.tip.modes.at(row), top, depth).multipliers(depth)
            if kind == FLIP:
                found = found[(found.imag == 0.0) & (found.real < 0.0)]
            return float(np.abs(found).max(initial=0.0))

        cuts = map(process, self.speed.tolist())
        every = zip(self.rows.tolist(), tops.tolist(), cuts, depth.tolist(), strict=True)
        found = [*each_in_threads(lambda one: radius(*one), [*every])]
        return np.array(found) < 1.0

    def _reported(self, found: Iterator[Limit]) -> list[Limit]:
        """Limits as they come, reported in parts."""
        every, count = [], len(self.rows)
        for limit in found:
            every.append(limit)
            if len(every) % max(1, count // PARTS) == 0:
                self.progress(f"{len(every)} of {count} speeds")
        return every

    def _sampled(self, tip: Tip, operation: Operation) -> list[Limit]:
        """Limits of a receptance that is no sum of modes."""
        if operation.spec.process_damping > 0.0:
            what = "leave process_damping and interval out, or take method: zero-order"
            raise InvalidInput(NOT_MODES.format(what=what))

        def limit(row: int, speed: float) -> Limit:
            return self._sampled_limit(tip, row, operation.process(speed))

        tip.tops  # noqa: B018  solved once, before threads ask for it
        every = [*zip(self.rows.tolist(), self.speed.tolist(), strict=True)]
        return self._reported(each_in_threads(lambda one: limit(*one), every))

    def _sampled_limit(self, tip: Tip, row: int, process: Process) -> Limit:
        one = tip.at(row)
        near, top = tip.about_poles(row), float(tip.tops[row])
        return sampled_limit(lambda w: one.receptance(w[None])[0], near, top, process)

    def _mean(self, operation: Operation) -> list[Limit]:
        """Zero-order limits, solved together for speeds whose tooth periods are similar."""
        delays = operation.delays(self.speed)
        period = delays.max(axis=1)
        found: list[Limit] = []
        most = float(self.tip.tops.max()) / TURN  # samples in a second
        for part in _alike(period, AT_ONCE / most):
            omega = self._samples(self.rows[part], period[part])
            mean = operation.mean(self.speed[part])
            directions, top = mean.cutting.shape[-1], float(omega[:, -1].max())
            receptance = self._receptance(self.rows[part], top, directions)
            sampled = receptance
            if self.tip.modes is None:
                known = self._samples(self.rows[part], period[part], MOST_SAMPLES)
                sampled = partial(_between, receptance, known)
            depth, at = zero_order(receptance, mean, delays[part], omega, sampled)
            found += [
                Limit(float(a), float(w) / (2.0 * math.pi), HOPF if math.isfinite(a) else NONE)
                for a, w in zip(depth, at, strict=True)
            ]
        return found

    def _samples(self, rows: Rows, period: Array, most: float = math.inf) -> Array:
        """Frequencies (s, f), ascending: those that resolve peaks, and even ones that resolve the
        phase from tooth to tooth unless that takes more than ``most``."""
        near = [self.tip.about_poles(row) for row in rows.tolist()]
        tops = self.tip.tops[rows]
        refuse_slow(float(tops.max()), float(period.max()))
        even = int(min(math.ceil(float((tops * period).max()) / TURN), most))
        longest = max(map(len, near))
        omega = np.empty((len(rows), even + longest))
        omega[:, :even] = tops[:, None] * (np.arange(1, even + 1) / even)
        for k, own in enumerate(near):
            at = np.linspace(0, len(own) - 1, longest)
            omega[k, even:] = np.interp(at, np.arange(len(own)), own)
        omega.sort(axis=1)
        return omega

    def _receptance(self, rows: Rows, top: float, directions: int) -> Callable[[Array], Complex]:
        """Receptance (s, f, directions, 2) by frequencies (s, f) up to ``top`` [rad/s]."""
        modes = self.tip.modes
        if modes is not None:
            return modes.of(rows, top, directions).receptance
        assert isinstance(self.tip, Tip)
        return partial(_summed, self.tip, rows, directions)


def _summed(tip: Tip, rows: Rows, directions: int, omega: Array) -> Complex:
    """Receptance at some rows; the tip asks for frequencies at all of its speeds."""
    if tip.count == 1:
        flat = tip.receptance(omega.reshape(1, -1))
        return flat.reshape(*omega.shape, 2, 2)[..., :directions, :]
    every = np.ones((tip.count, omega.shape[1]))
    every[rows] = omega
    return tip.receptance(every)[rows][..., :directions, :]


def _between(receptance: Callable[[Array], Complex], known: Array, omega: Array) -> Complex:
    """Receptance at ``omega`` (s, f) by cubic splines through those at ``known`` (s, k), where
    these are fewer."""
    if known.shape == omega.shape:
        return receptance(omega)
    from scipy.interpolate import CubicSpline

    found = []
    for at, values, asked in zip(known, receptance(known), omega, strict=True):
        once, first = np.unique(at, return_index=True)
        found.append(CubicSpline(once, values[first])(asked))
    return np.stack(found)


def _alike(period: Array, most: float) -> Iterator[slice]:
    """Runs of speeds with periods that differ by up to ``TOGETHER`` and are ``most`` [s] together;
    periods descend."""
    first = 0
    for k in range(1, len(period) + 1):
        many = (k - first + 1) * period[first] > most
        if k == len(period) or many or period[first] > TOGETHER * period[k]:
            yield slice(first, k)
            first = k
