"""How many eigenvalues of K φ = λ M φ lie below a bound: the negative pivots of K − bound · M.

By Sylvester's law of inertia the pivots of a symmetric factorisation tell it without a single
eigenvalue (Parlett, *The Symmetric Eigenvalue Problem*, 1998, ch. 3): what a search for eigenvalues
has missed is seen.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.numerics.sparse import Matrix

ASIDE = 1e-7  # of a bound that is an eigenvalue of some leading part, where a pivot vanishes
TRIES = 4


def count_below(
    stiffness: Matrix, mass: Matrix, bound: float, order: NDArray[np.intp]
) -> int | None:
    """Eigenvalues below ``bound``; matrices of compressed rows, (n, n), eliminated in ``order``
    (n,), which keeps them narrow. None where pivots vanish."""
    for each in range(TRIES):
        shifted = (stiffness - (1.0 - each * ASIDE) * bound * mass)[order][:, order]
        pivots = _pivots(shifted)
        if pivots is not None:
            return int((pivots < 0.0).sum())
    return None


def condensed(
    matrix: Matrix, chosen: NDArray[np.intp], others: NDArray[np.intp]
) -> NDArray[np.float64]:
    """A symmetric matrix of compressed rows on its ``chosen`` rows, nothing acting on the
    ``others``, which are eliminated in this order; NaN where these are not positive definite."""
    own = matrix[chosen][:, chosen].toarray()
    factors = _eliminated(matrix[others][:, others])
    if factors is None or (factors.U.diagonal() <= 0.0).any():
        return np.full_like(own, np.nan)
    across = matrix[others][:, chosen].toarray()
    return np.asarray(own - across.T @ factors.solve(across))


def _pivots(matrix: Matrix) -> NDArray[np.float64] | None:
    """Of a symmetric elimination that exchanges nothing; None where it cannot be done."""
    factors = _eliminated(matrix)
    pivots = None if factors is None else factors.U.diagonal()
    return pivots if pivots is not None and np.isfinite(pivots).all() and pivots.all() else None


def _eliminated(matrix: Matrix) -> Any:
    """Factors L U without any exchange, or None."""
    from scipy.sparse.linalg import splu

    try:
        factors = splu(
            matrix.tocsc(),
            permc_spec="NATURAL",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True, "Equil": False},
        )
    except RuntimeError:  # singular to the last bit
        return None
    every = np.arange(matrix.shape[0])
    exchanged = (factors.perm_r != every).any() or (factors.perm_c != every).any()
    return None if exchanged else factors
