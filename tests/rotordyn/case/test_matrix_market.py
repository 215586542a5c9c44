"""Matrix Market files: the matrices that SciPy reads from them."""

from __future__ import annotations

import io

import numpy as np
import pytest
import scipy.io
import scipy.sparse

from rotordyn.case.matrix_market import MarketFile

KINDS = {
    "general": np.array([[4.0, -1.5], [2.0, 0.0]]),
    "symmetric": np.array([[4.0, -1.5, 0.0], [-1.5, 3.0, 1e-12], [0.0, 1e-12, 7e9]]),
    "skew-symmetric": np.array([[0.0, -1.5, 2.0], [1.5, 0.0, 0.0], [-2.0, 0.0, 0.0]]),
}


@pytest.mark.parametrize("symmetry", KINDS)
@pytest.mark.parametrize("form", [np.array, scipy.sparse.coo_array])
@pytest.mark.parametrize("field", ["real", "integer"])
def test_a_matrix_comes_back_as_written(symmetry: str, form: type, field: str) -> None:
    matrix, file = (
        np.trunc(KINDS[symmetry]) if field == "integer" else KINDS[symmetry],
        io.BytesIO(),
    )
    scipy.io.mmwrite(file, form(matrix), comment="a note", field=field, symmetry=symmetry)
    read = MarketFile(file.getvalue())
    assert read.shape == matrix.shape
    assert read.matrix().tolist() == matrix.tolist()


def test_entries_given_twice_are_added_and_a_pattern_is_ones() -> None:
    head = b"%%MatrixMarket matrix coordinate "
    twice = head + b"real general\n%\n2 2 3\n1 1 1.0\n\n1 1 2.5\n2 1 4\n"
    assert MarketFile(twice).matrix().tolist() == [[3.5, 0.0], [4.0, 0.0]]
    assert MarketFile(head + b"pattern symmetric\n2 2 1\n2 1\n").matrix().tolist() == [
        [0, 1],
        [1, 0],
    ]


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"nonsense",
        b"%%MatrixMarket vector array real general\n1 1\n1\n",
        b"%%MatrixMarket matrix array complex general\n1 1\n1 0\n",
        b"%%MatrixMarket matrix array real hermitian\n1 1\n1\n",
        b"%%MatrixMarket matrix list real general\n1 1\n1\n",
        b"%%MatrixMarket matrix array real general\n1 1 1\n1\n",
        b"%%MatrixMarket matrix array real general\n2 2\n1\n",
        b"%%MatrixMarket matrix array real general\n2 2\n1 2 3 x\n",
        b"%%MatrixMarket matrix coordinate real general\n2 2 1\n0 1 1\n",
        b"%%MatrixMarket matrix coordinate real general\n2 2 1\n3 1 1\n",
        b"%%MatrixMarket matrix coordinate real general\n2 2 1\nnan 1 1\n",
        b"%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 1\n",
        b"%%MatrixMarket matrix coordinate real general\n-2 2 1\n1 1 1\n",
        b"\xff\xfe",
    ],
)
def test_other_files_are_refused(content: bytes) -> None:
    with pytest.raises((ValueError, IndexError, KeyError)):
        MarketFile(content).matrix()
