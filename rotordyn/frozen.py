"""An immutable mapping."""

from __future__ import annotations

from typing import Any, NoReturn


class FrozenMapping(dict[Any, Any]):
    """An immutable, hashable dict; ``dict(it)`` returns a copy that may be changed."""

    def _refuse(self, *_: object, **__: object) -> NoReturn:
        raise TypeError("a description is not changed: vary or dataclasses.replace make another")

    __setitem__ = __delitem__ = __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __hash__(self) -> int:  # type: ignore[override]
        return hash(frozenset(self.items()))

    def __reduce__(self) -> tuple[type, tuple[dict[Any, Any]]]:
        """Copy and pickle by content, since filling item by item is not allowed."""
        return type(self), (dict(self),)


def frozen(value: Any) -> Any:
    """Convert a dict to an immutable one; return other values unchanged."""
    return FrozenMapping(value) if type(value) is dict else value
