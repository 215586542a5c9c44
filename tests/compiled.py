"""Compiles the bearing solver for the kinds that tests solve:  python -m tests.compiled

``scripts/check`` runs it beside the checks of style and types, which leave a processor free: else
each process of the tests would compile for itself, a quarter of a minute for every kind.
"""

from __future__ import annotations

from tests.oracles.known_bearings import VEX70
from tests.oracles.known_grooves import QJ218, deep_groove, drawn_6210, four_point

if __name__ == "__main__":
    for bearing in (VEX70, deep_groove(drawn_6210()), four_point(QJ218)):
        bearing.equilibrium(load=[500.0, 0.0, 0.0, 0.0, 0.0], speed=100.0, compiled=True)
