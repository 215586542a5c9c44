"""The usual Newton iteration on four unknowns a ball: X1, X2, δi, δo, from the unloaded geometry.

What many programs do: no damping, no continuation. It shows what such an iteration finds, and is
no reference. ``signed``: a stretched contact pulls, k sign(δ) |δ|^1.5; else it carries nothing.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tests.oracles.ball_equations import Balls

Array = NDArray[np.float64]
MICROMETRE = 1e-6
STEPS = 60


def plain_newton(
    balls: Balls, a: Array, speed: Array, *, signed: bool
) -> tuple[Array, NDArray[np.bool_]]:
    """(X1, X2, δi, δo) of shape (4, n), and where the iteration converged."""
    angle = balls.bearing.contact_angle
    u = np.empty((4, a.shape[1]))
    u[0], u[1] = balls.lo * math.sin(angle), balls.lo * math.cos(angle)
    u[2:] = MICROMETRE
    with np.errstate(all="ignore"):  # it may run away
        return u, _iterated(balls, a, speed, u, signed=signed)


def _iterated(balls: Balls, a: Array, speed: Array, u: Array, *, signed: bool) -> NDArray[np.bool_]:
    """Where it converged; ``u`` is moved on."""
    done = np.zeros(a.shape[1], dtype=bool)
    todo = np.arange(a.shape[1])
    for _ in range(STEPS):
        part = u[:, todo]
        fault, size = _fault(balls, a[:, todo], part, speed[todo], signed=signed)
        small = _converged(balls, fault, size)
        done[todo[small]] = True
        sane = np.isfinite(fault).all(axis=0) & (np.abs(part).max(axis=0) < 1.0) & ~small
        todo, fault, part = todo[sane], fault[:, sane], part[:, sane]
        if not todo.size:
            break
        jac = np.empty((todo.size, 4, 4))
        for k in range(4):
            step = 1e-4 * MICROMETRE * (np.arange(4) == k)[:, None]
            up, down = (
                _fault(balls, a[:, todo], part + s * step, speed[todo], signed=signed)[0]
                for s in (1.0, -1.0)
            )
            jac[:, :, k] = (up - down).T / 2e-4
        u[:, todo] = part - MICROMETRE * _solve(jac, fault)
    return done


def _fault(balls: Balls, a: Array, u: Array, speed: Array, *, signed: bool) -> tuple[Array, Array]:
    """Two lengths [µm] and two forces [N], (4, n); the largest load of each ball."""
    x, v = u[:2], a - u[:2]
    angles = np.arctan2(v[0], v[1]), np.arctan2(x[0], x[1])
    b = balls.at(*angles, u[2], u[3], speed, signed=signed)
    lengths = [
        ((v**2).sum(axis=0) / (balls.li + u[2]) - (balls.li + u[2])) / (2.0 * MICROMETRE),
        ((x**2).sum(axis=0) / (balls.lo + u[3]) - (balls.lo + u[3])) / (2.0 * MICROMETRE),
    ]
    size = np.maximum(np.maximum(np.abs(b["qi"]), np.abs(b["qo"])), b["fc"])
    return np.array([*lengths, *balls.forces(b)[0]]), size


def _converged(balls: Balls, fault: Array, size: Array) -> NDArray[np.bool_]:
    close = np.abs(fault[:2]).max(axis=0) < 1e-7
    return np.asarray(close & (np.abs(fault[2:]).max(axis=0) < 1e-8 * size + 1e-9))


def _solve(jac: Array, fault: Array) -> Any:
    """Newton steps [µm]; none where the matrix is singular."""
    weight = 1.0 / (np.abs(jac).max(axis=2, keepdims=True) + 1e-300)
    scaled = jac * weight
    regular = np.isfinite(scaled).all(axis=(1, 2))
    regular[regular] = np.abs(np.linalg.det(scaled[regular])) > 1e-14
    safe = np.where(regular[:, None, None], scaled, np.eye(4))
    step = np.linalg.solve(safe, (fault.T[:, :, None] * weight))[..., 0].T
    return np.where(regular, step, np.nan)


def kind_of_root(balls: Balls, u: Array, physical: Array, lost: NDArray[np.bool_]) -> NDArray[Any]:
    """``"physical"``, ``"tensile"`` (a contact pulls, or is said to be open and is not the lost
    ball), ``"other"``; ``physical`` (2, n) is the ball centre that belongs to the state."""
    apart = np.hypot(*(u[:2] - physical))
    near = apart < 1e-3 * np.maximum(np.abs(u[2:]).max(axis=0), 1e-9)
    pulls = (u[2] < 0.0) | (u[3] < 0.0)
    return np.where(near & (lost | ~pulls), "physical", np.where(pulls, "tensile", "other"))
