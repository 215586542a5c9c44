"""Settings shared by every test: how hypothesis draws its examples."""

from __future__ import annotations

from hypothesis import HealthCheck, settings

# Duration says nothing about correctness: no deadline, no complaint about a slow machine.
_UNHURRIED = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("explore", _UNHURRIED)
settings.register_profile("ci", _UNHURRIED, derandomize=True, print_blob=True)
settings.load_profile("explore")
