"""What tests of identifications share."""

from __future__ import annotations

import pytest

from rotordyn.study.identification.responses import Responses
from tests.rotordyn.study.rotor_twin import measured, spindle


@pytest.fixture(scope="session")
def taps() -> Responses:
    """Responses of the synthetic rotor to taps."""
    return measured(spindle())
