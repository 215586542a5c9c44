"""Connected components of a graph of few nodes.

Those of ``scipy.sparse`` would take longer to import than most runs take.
"""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Flags, Indices


def first_joined(joined: Flags) -> Indices:
    """Return the first member of the connected component of each of n things (n,); ``joined``
    (n, n): connected pairs, given one way or both."""
    reached = joined | joined.T | np.eye(len(joined), dtype=bool)
    for _ in range(len(joined).bit_length()):  # each doubles the length of paths
        reached = reached @ reached
    return reached.argmax(axis=1) if len(joined) else np.zeros(0, dtype=np.intp)


def join(joined: Flags, owner: Indices, coupled: Flags) -> None:
    """Mark in ``joined`` the owners (m,) of what is ``coupled`` (m, m)."""
    rows, columns = np.nonzero(coupled)
    joined[owner[rows], owner[columns]] = True
