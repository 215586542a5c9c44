"""Dense matrices from Matrix Market files (https://math.nist.gov/MatrixMarket/formats.html).

SciPy reads them too, but takes as long to load as all else of the check of a case.
"""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array

_SIGNS = {"general": 0, "symmetric": 1, "skew-symmetric": -1}  # of entries across the diagonal


class MarketFile:
    """The matrix of real numbers in a file; ValueError or LookupError if there is none.

    ``shape`` and the number of ``entries`` in the file are known before the matrix is built.
    """

    def __init__(self, content: bytes) -> None:
        lines = content.decode("utf-8").splitlines()
        banner, what, self._form, self._numbers, symmetry = lines[0].lower().split()
        kinds = ("real", "double", "integer", "pattern")
        if (banner, what) != ("%%matrixmarket", "matrix") or self._numbers not in kinds:
            raise ValueError("not a matrix of real numbers")
        held = [line for line in lines if line.strip() and not line.startswith("%")]
        sizes = [*map(int, held[0].split())]
        if min(sizes) < 0 or len(sizes) != {"array": 2, "coordinate": 3}[self._form]:
            raise ValueError("not the size of a matrix")
        self.shape, self.entries = (sizes[0], sizes[1]), sizes[2] if sizes[2:] else 0
        self._sign, self._text = _SIGNS[symmetry], " ".join(held[1:])

    def matrix(self) -> Array:
        """The whole matrix."""
        given, sign = np.array(self._text.split(), dtype=np.float64), self._sign
        if self._form == "coordinate":
            pattern = self._numbers == "pattern"
            table = given.reshape(self.entries, 2 if pattern else 3)
            places = table[:, :2]
            if not ((places >= 1.0) & (places <= self.shape)).all():
                raise ValueError("rows and columns are counted from 1")
            row, column = places.astype(int).T - 1
            values = np.ones(self.entries) if pattern else table[:, 2]
        else:  # column by column; of a symmetric matrix the lower triangle
            column, row = np.indices(self.shape[::-1]).reshape(2, -1)
            stored = (row >= column + (sign < 0)) | (sign == 0)
            row, column, values = row[stored], column[stored], given.reshape(stored.sum())
        whole = np.zeros(self.shape)
        np.add.at(whole, (row, column), values)
        across = (row != column) & (sign != 0)
        np.add.at(whole, (column[across], row[across]), sign * values[across])
        return whole
