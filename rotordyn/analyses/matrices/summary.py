"""The matrices in a line of text."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.matrices.result import MatricesResult
from rotordyn.results.described import Described
from rotordyn.results.display import RPM, rounded_up, shown
from rotordyn.results.headline import Number
from rotordyn.results.severity import Severity, of_severity
from rotordyn.scene.refinement import RESPONSES


def summary(result: MatricesResult) -> list[str]:
    """Number of coordinates, ports and solved speeds of the matrices."""
    count, ports, speeds = len(result.column), len(result.port), result.outcome.count("")
    return [
        f"matrices   {count} coordinates with mass 1, for frequencies up to "
        f"{result.max_frequency:g} Hz, and {ports} port{'s' * (ports > 1)} at {speeds} "
        f"speed{'s' * (speeds > 1)}: results.nc, matrices.mat"
    ]


def numbers(result: MatricesResult, _: Described) -> Iterator[Number]:
    """The highest peak of the receptance at every port, at the first and the last speed."""
    for k, port in enumerate(result.port):
        printed = shown(result.unit(k))
        for row, speed in enumerate(result.shown_speed):
            highest = float(np.nanmax(np.abs(result.receptance[row, k]))) * printed.factor
            yield Number(port, printed.unit, highest, speed=float(speed * RPM.factor), digits=3)


def accuracy(result: MatricesResult) -> list[str]:
    """Estimated error of the poles; none without error checks."""
    if math.isnan(result.frequency_error):
        return []
    return [f"frequencies of the matrices within {rounded_up(result.frequency_error)}"]


@of_severity(Severity.INVALID)
def warnings(result: MatricesResult) -> list[str]:
    """Warning that the requested accuracy is not reached."""
    worst = max(RESPONSES * result.frequency_error, result.receptance_error)
    if not worst > result.error_asked:
        return []
    return [
        "matrices: the model changes as it is refined, frequencies by up to "
        f"{result.frequency_error:.0e}, receptances between the ports by up to "
        f"{result.receptance_error:.0e}: lower max_frequency, or make very stiff supports rigid"
    ]
