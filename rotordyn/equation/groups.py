"""Which of many things are joined, directly or by way of others."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Indices


class Groups:
    """Sets of numbers below ``count``, joined in pairs."""

    def __init__(self, count: int) -> None:
        self._parent = list(range(count))

    def find(self, k: int) -> int:
        while self._parent[k] != k:
            k = self._parent[k]
        return k

    def join(self, a: int, b: int) -> None:
        low, high = sorted((self.find(int(a)), self.find(int(b))))
        self._parent[high] = low

    def join_where(self, owner: Indices, coupled: np.ndarray) -> None:
        """The owners (n,) of what is ``coupled`` (n, n)."""
        rows, columns = np.nonzero(coupled)
        for a, b in set(zip(owner[rows].tolist(), owner[columns].tolist(), strict=True)):
            self.join(a, b)

    def roots(self) -> list[int]:
        return sorted({self.find(k) for k in range(len(self._parent))})
