"""Uncertainty of identified values: intervals, inseparable unknowns, binding bounds.

The covariance follows from the derivatives at the best machine, (JᵀJ)⁻¹, with priors as rows; where
residuals exceed the stated noise it is scaled up by χ² over the degrees of freedom (R. Birge,
Phys. Rev. 40, 1932), never down. Estimates of least absolute differences have a standard deviation
larger by √(π/2) in normal noise (G. Bassett and R. Koenker, J. Am. Stat. Assoc. 73, 1978), and the
scale follows from the median of the differences, which is robust against outliers. Undetermined
directions are those of small singular values of the data's rows, unknowns scaled by their priors.

Theory: docs/theory/identification.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array, Flags
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.search import Fit
from rotordyn.study.identification.unknown import Sought

COVERED = 0.95
BINDING = 1e-3  # distance from a bound over the range, up to which an unknown is on the bound
VAGUE = 0.5  # deviation over that known before, above which an unknown is unidentifiable
BY_PRIOR = 0.9  # deviation over that of the prior, above which the data add nothing
IDLE = 0.01  # effect of an unknown over the noise, below which no measurement depends on it
PART = 0.2  # component of a direction, over the largest, from which an unknown is named
TIED = 0.95  # correlation from which two unknowns are called inseparable
REFUTED = 0.05  # probability of a χ² as large, below which the stated noise is rejected
QUARTILE = 0.6745  # median of absolute values of a normal distribution, over its deviation
LOST = 1e-6  # least singular value: with 0 the deviation becomes a million scales

IDENTIFIED = "identifiable"
ON_A_BOUND = "on a bound"
UNIDENTIFIABLE = "unidentifiable"
BY_ITS_PRIOR = "known by its prior alone"
UNFINISHED = "search not finished"


@dataclass(frozen=True, eq=False, slots=True)
class Certainty:
    """Uncertainty of ``values`` (p,): standard ``deviation`` (p,), 95 % ``interval`` (p, 2) [SI],
    limited to the bounds of the unknowns; NaN if the search ended by its limit.

    ``covariance`` (p, p): of unknowns over their scales, rows of those on a bound 0; ``words``
    (p,): verdict on each; ``singular`` values (q,) and ``directions`` (q, p) that the data do not
    determine, least determined first; ``degrees`` of freedom, ``reduced``: χ² over these;
    ``birge``: factor on all deviations, √reduced (or the scale by absolute differences) if above 1;
    ``quantile``: at 97.5 %, of the normal distribution if that factor is 1, of Student's t if the
    stated noise is improbable, interpolated in between. ``idle`` (p,): unknowns off their bounds on
    which no measurement depends.
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
        """Correlation of the unknowns (p, p), NaN for one on a bound."""
        size = np.sqrt(np.diag(self.covariance))
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(self.covariance / np.outer(size, size))


def certainty(problem: Problem, fit: Fit, *, absolute: bool = False) -> Certainty:
    """Uncertainty of the values of a fit, of least squares or of least ``absolute`` differences."""
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
    """Quantile at 97.5 %: of the normal distribution at a factor of 1, where the stated noise is
    taken as known; of Student's t where the probability of a χ² as large is below ``REFUTED``;
    linear in that probability in between, so that no interval jumps."""
    from scipy.stats import chi2, norm, t

    usual, chance = chi2.sf(degrees * np.array([1.0, birge**2]), degrees)
    share = np.clip((usual - chance) / (usual - REFUTED), 0.0, 1.0)
    level = 0.5 + 0.5 * COVERED
    return float((1.0 - share) * norm.ppf(level) + share * t.ppf(level, degrees))


def _by_median(problem: Problem, fit: Fit, free: Flags) -> float:
    """Robust standard deviation of the differences over the stated noise, by the median of their
    absolute values. The smallest ones are omitted, as many as there are ``free`` values and
    nuisances, since the fit makes as many zero (W. DuMouchel and F. O'Brien, Proc. 21st Symp.
    Interface, 1989)."""
    pairs = zip(problem.weighings, fit.predicted, strict=True)
    sizes = np.abs(
        np.concatenate([w.anew(one).residual(one) / w.data.deviation for w, one in pairs])
    )
    zeros = int(free.sum()) + sum(len(m.data.column_names) for m in problem.measurements)
    remaining = np.sort(sizes)[zeros:]
    return float(np.median(remaining)) / QUARTILE if len(remaining) else 0.0


def on_bound(problem: Problem, values: Array) -> Flags:
    """Flags of unknowns on one of their bounds (p,)."""
    low, high = problem.bounds
    room = BINDING * (high - low)
    return np.asarray((values - low < room) | (high - values < room))


def _inverse(rows: Array) -> Array:
    """(JᵀJ)⁻¹ (p, p); a direction on which no row depends gets a very large deviation."""
    if not rows.shape[1]:
        return np.empty((0, 0))
    _, singular, v = np.linalg.svd(rows, full_matrices=False)
    padded = np.zeros(rows.shape[1])
    padded[: len(singular)] = singular
    return np.asarray((v.T / np.maximum(padded, LOST)[: len(v)] ** 2) @ v)


def _soft(data: Array, free: Flags, birge: float) -> tuple[Array, Array]:
    """Singular values (q,) and directions (q, p) along which data add little to prior knowledge."""
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
    """Sentences on directions and pairs of unknowns that the data do not separate."""
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
                    f"their {what} is determined best"
                )
    return sentences
