"""The operating state: networks on the axis, followed through loads, shifts and speeds."""

from __future__ import annotations

from rotordyn.state.along import NoEquilibrium
from rotordyn.state.follow import follow

__all__ = ["NoEquilibrium", "follow"]
