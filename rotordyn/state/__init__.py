"""The operating state: networks on the axis, followed through loads, shifts and speeds.

``plain`` reads a ``network`` with the ``laws`` of its bearings, ``rest`` mounts it, ``along``
follows a step of its path: ``contacts`` between two events, ``conditions`` that end such a part,
``rates`` that determine how it continues, ``settle`` after a snap.
"""

from __future__ import annotations

from rotordyn.state.follow import follow
from rotordyn.state.no_equilibrium import NoEquilibrium

__all__ = ["NoEquilibrium", "follow"]
