"""The matrices in a file of MATLAB, which Octave, Julia and SciPy read as well."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

from rotordyn.analyses.contract import File
from rotordyn.analyses.matrices.result import MatricesResult
from rotordyn.plain import plain
from rotordyn.results.described import Described


def files(folder: Path, case: Described, result: MatricesResult) -> Iterator[File]:
    """The file ``matrices.mat``."""
    path = folder / "matrices.mat"
    yield path.name, partial(write_mat, path, result, case.name)


def write_mat(path: Path, result: MatricesResult, case: str) -> None:
    """Write M, K, C, G, L, the speeds [rad/s] and the names of the ports, in SI; the speed is the
    last dimension of K and C: ``K(:,:,k)``."""
    from scipy.io import savemat

    names = np.empty(len(result.port), dtype=object)
    names[:] = [plain(port) for port in result.port]
    variables = {
        "M": np.eye(len(result.column)),
        "K": np.moveaxis(result.stiffness, 0, -1),
        "C": np.moveaxis(result.damping, 0, -1),
        "G": result.gyroscopic,
        "L": result.motion,
        "speed": result.speed,
        "ports": names,
        "title": f"case {plain(case)}: M q'' + C q' + K q = L' f, u = L q, SI, by rotordyn",
    }
    savemat(path, variables, do_compression=True, oned_as="column")
