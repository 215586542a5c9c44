"""The operating state: networks on the axis, followed through loads, shifts and speeds."""

from __future__ import annotations

from rotordyn.state.follow import follow
from rotordyn.state.no_equilibrium import NoEquilibrium

__all__ = ["NoEquilibrium", "follow"]
