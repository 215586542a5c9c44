"""How sure identified values are: intervals, what data cannot separate, ends that bind.

Covariance from the derivatives at the best machine, (JᵀJ)⁻¹, with priors as rows; where residuals
are larger than the stated noise it is scaled up by their χ² over the degrees of freedom (R. Birge,
Phys. Rev. 40, 1932), never down. Values of the least absolute differences deviate by √(π/2) more in
normal noise (G. Bassett and R. Koenker, J. Am. Stat. Assoc. 73, 1978), and the scale is that of the
median of these, which outliers leave alone. Directions from the singular values of the data's rows
alone, unknowns measured by what was known of them before.

Theory: docs/theory/identification.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.search import Fit
from rotordyn.study.identification.unknown import Sought

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
COVERED = 0.95
BINDING = 1e-3  # of the way between ends: an unknown that near stands on one
VAGUE = 0.5  # of what was known before: a deviation above says nothing
BY_PRIOR = 0.9  # of the deviation of a prior: the data add nothing
IDLE = 0.01  # of the noise, over what was known before: a change below it is none
PART = 0.2  # of the largest part of a direction: named
TIED = 0.95  # correlation from which two unknowns are named together
REFUTED = 0.05  # probability of a χ² as large by the stated noise, below which that is not it
QUARTILE = 0.6745  # median of absolute values of a normal distribution, over its deviation
LOST = 1e-6  # least singular value: along one that is 0 the deviation is a million scales

IDENTIFIED = "identifiable"
ON_A_BOUND = "on a bound"
UNIDENTIFIABLE = "unidentifiable"
BY_ITS_PRIOR = "known by its prior alone"
UNFINISHED = "search not finished"


@dataclass(frozen=True, eq=False, slots=True)
class Certainty:
    """How sure ``values`` (p,) are: standard ``deviation`` (p,) and 95 % ``interval`` (p, 2) [SI],
    as far as the ends of the unknowns; NaN where the search ended by its limit.

    ``covariance`` (p, p): each unknown over its scale, rows of those on a bound 0; ``words`` (p,):
    verdict on each; ``singular`` values (q,) and ``directions`` (q, p) that the data do not
    determine, softest first; ``degrees`` of freedom, ``reduced``: χ² over these; ``birge``: factor
    of all deviations, √reduced (or the scale by absolute differences) where above 1; ``quantile``:
    at 97.5 %, of the normal distribution where that factor is 1, of Student's t where noise as
    stated would hardly leave such residuals, between them in between. ``idle`` (p,): which of
    those off their bounds no measurement follows.
    """

    values: Array
    deviation: Array
    interval: Array
    covariance: Array
    words: tuple[str, ...]
    singular: Array
    directions: Array
    degrees: int
    reduced: float
    birge: float
    quantile: float
    idle: Flags

    @property
    def correlation(self) -> Array:
        """Of the unknowns (p, p), NaN where one stands on a bound."""
        size = np.sqrt(np.diag(self.covariance))
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(self.covariance / np.outer(size, size))


def certainty(problem: Problem, fit: Fit, *, absolute: bool = False) -> Certainty:
    """How sure the values of a fit are, of least squares or of least ``absolute`` differences."""
    unknowns, scale = problem.unknowns, problem.scale
    free = ~on_bound(problem, fit.values)
    slopes = problem.slopes(fit.values, fit.predicted, central=True)
    data = problem.weighed_slopes(slopes)[:, free]
    if absolute:
        data /= np.sqrt(0.5 * np.pi)
    rows = np.concatenate([data, problem.prior_slopes[:, free]])
    priors = sum(each.deviation is not None for each in unknowns)
    nuisances = [d for m in problem.measurements for d in m.data.column_deviation]
    degrees = problem.count + priors - int(free.sum()) - int(np.isinf(nuisances).sum())
    reduced = fit.cost / max(degrees, 1)
    birge = max(1.0, _by_median(problem, fit, free) if absolute else float(np.sqrt(reduced)))
    covariance = np.zeros((len(scale), len(scale)))
    covariance[np.ix_(free, free)] = np.nan if fit.limited else _inverse(rows) * birge**2
    deviation = scale * np.sqrt(np.diag(covariance))
    quantile = _quantile(birge, max(degrees, 1))
    half = quantile * deviation
    low, high = problem.bounds
    ends = np.clip(fit.values + half * np.array([[-1.0], [1.0]]), low, high).T
    singular, directions = _soft(data, free, birge)
    idle = free.copy()
    idle[free] = np.sqrt((data**2).sum(axis=0)) < IDLE
    words = tuple(
        _word(unknown, float(size), bool(on))
        for unknown, size, on in zip(unknowns, deviation, ~free, strict=True)
    )
    return Certainty(
        fit.values,
        deviation,
        ends,
        covariance,
        words,
        singular,
        directions,
        degrees,
        reduced,
        birge,
        quantile,
        idle,
    )


def _quantile(birge: float, degrees: int) -> float:
    """At 97.5 %: of the normal distribution at a factor of 1, where the stated noise is taken as
    known, and of Student's t where the probability of a χ² as large is below ``REFUTED``; between
    these linear in that probability, so that no interval jumps."""
    from scipy.stats import chi2, norm, t

    usual, chance = chi2.sf(degrees * np.array([1.0, birge**2]), degrees)
    share = np.clip((usual - chance) / (usual - REFUTED), 0.0, 1.0)
    level = 0.5 + 0.5 * COVERED
    return float((1.0 - share) * norm.ppf(level) + share * t.ppf(level, degrees))


def _by_median(problem: Problem, fit: Fit, free: Flags) -> float:
    """Deviation of the differences over the stated noise, by the median of absolute ones; as many
    of the smallest left out as there are ``free`` values and nuisances, which make these 0
    (W. DuMouchel and F. O'Brien, Proc. 21st Symp. Interface, 1989)."""
    pairs = zip(problem.weighings, fit.predicted, strict=True)
    sizes = np.abs(
        np.concatenate([w.anew(one).residual(one) / w.data.deviation for w, one in pairs])
    )
    zeros = int(free.sum()) + sum(len(m.data.column_names) for m in problem.measurements)
    left = np.sort(sizes)[zeros:]
    return float(np.median(left)) / QUARTILE if len(left) else 0.0


def on_bound(problem: Problem, values: Array) -> Flags:
    """Unknowns that stand on one of their ends (p,)."""
    low, high = problem.bounds
    room = BINDING * (high - low)
    return np.asarray((values - low < room) | (high - values < room))


def _inverse(rows: Array) -> Array:
    """(JᵀJ)⁻¹ (p, p); a direction that no row knows deviates without end."""
    if not rows.shape[1]:
        return np.empty((0, 0))
    _, singular, v = np.linalg.svd(rows, full_matrices=False)
    whole = np.zeros(rows.shape[1])
    whole[: len(singular)] = singular
    return np.asarray((v.T / np.maximum(whole, LOST)[: len(v)] ** 2) @ v)


def _soft(data: Array, free: Flags, birge: float) -> tuple[Array, Array]:
    """Singular values and directions (q, p) along which data say less than was known before."""
    if not data.shape[1]:
        return np.empty(0), np.empty((0, len(free)))
    _, singular, v = np.linalg.svd(data, full_matrices=True)
    values = np.zeros(len(v))
    values[: len(singular)] = singular
    soft = birge > VAGUE * values
    directions = np.zeros((int(soft.sum()), len(free)))
    directions[:, free] = v[soft]
    return values[soft][::-1], directions[::-1]


def _word(unknown: Sought, deviation: float, on: bool) -> str:
    if on:
        return ON_A_BOUND
    if np.isnan(deviation):
        return UNFINISHED
    share = deviation / unknown.scale
    if unknown.deviation is not None:
        return BY_ITS_PRIOR if share > BY_PRIOR else IDENTIFIED
    return UNIDENTIFIABLE if share > VAGUE else IDENTIFIED


def inseparable(unknowns: tuple[Sought, ...], sure: Certainty) -> list[str]:
    """What cannot be told apart, a sentence for each."""
    sentences = []
    for direction in sure.directions:
        chosen = np.flatnonzero(np.abs(direction) > PART * np.abs(direction).max())
        order = chosen[np.argsort(-np.abs(direction[chosen]))]
        first = np.sign(direction[order[0]])
        parts = [f"{abs(direction[k]):.2f} {unknowns[k].name}" for k in order]
        signs = ["−" if direction[k] * first < 0.0 else "+" for k in order]
        words = " ".join(f"{s} {p}" for s, p in zip(signs, parts, strict=True)).removeprefix("+ ")
        sentences.append(
            f"the data do not determine {words}"
            + (" (each over what was known of it before)" if len(order) > 1 else "")
        )
    correlation = sure.correlation
    soft = np.abs(sure.directions)
    named = [row > PART * row.max() for row in soft]
    for k, one in enumerate(unknowns):
        for j in range(k):
            rho = correlation[k, j]
            if abs(rho) >= TIED and not any(row[j] and row[k] for row in named):
                what = "difference" if rho > 0.0 else "sum"
                sentences.append(
                    f"{unknowns[j].name} and {one.name} can hardly be separated: ρ {rho:+.2f}, "
                    f"their {what} is known best"
                )
    return sentences
