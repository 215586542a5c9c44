"""Residual unbalance that a balance quality grade permits, and how two planes share it."""

from __future__ import annotations

LEAST_SHARE = 0.3  # of the whole in either plane


def permissible_unbalance(quality: float, mass: float, speed: float) -> float:
    """U = G m / Ω [kg·m] (ISO 21940-11) of ``quality`` G [m/s], ``mass`` [kg], ``speed`` [rad/s].

    >>> round(permissible_unbalance(2.5e-3, 20.0, 2500.0) * 1e6, 6)  # g·mm
    20.0
    """
    return quality * mass / speed


def plane_shares(centre: float, first: float, second: float) -> tuple[float, float]:
    """Return the shares of two planes with the centre of gravity between them, stations in m.

    They follow from the levers; neither is below ``LEAST_SHARE``.

    >>> plane_shares(0.75, 0.0, 1.0), plane_shares(0.95, 0.0, 1.0)
    ((0.3, 0.7), (0.3, 0.7))
    """
    lever = (second - centre) / (second - first)
    share = min(max(lever, LEAST_SHARE), 1.0 - LEAST_SHARE)
    return share, 1.0 - share
