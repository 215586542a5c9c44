"""A mapping that stays as it was made."""

from __future__ import annotations

from typing import Any, NoReturn


class FrozenMapping(dict[Any, Any]):
    """A dict that may only be read, and is hashed by what it holds; ``dict(it)`` may be changed."""

    def _refuse(self, *_: object, **__: object) -> NoReturn:
        raise TypeError("a description is not changed: vary or dataclasses.replace make another")

    __setitem__ = __delitem__ = __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __hash__(self) -> int:  # type: ignore[override]
        return hash(frozenset(self.items()))

    def __reduce__(self) -> tuple[type, tuple[dict[Any, Any]]]:
        """Copied and pickled by what it holds, since neither may fill it item by item."""
        return type(self), (dict(self),)


def frozen(value: Any) -> Any:
    """A dict as one that may only be read; anything else as it is."""
    return FrozenMapping(value) if type(value) is dict else value
