"""The table of contents next to pages of files, which are most pages: made once for each depth.

None of these pages is in it, so it differs only in the relative path of its links.
"""

from __future__ import annotations

from functools import partial
from typing import Any

from docs.site.links import SHOWN


def setup(app: Any) -> dict[str, bool]:
    """Replace that of the theme before it is used."""
    app.connect("html-page-context", partial(_share, {}), priority=400)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _share(
    made: dict[Any, str], app: Any, page: str, template: str, context: dict[str, Any], tree: Any
) -> None:
    if page.startswith(SHOWN):
        make, depth = context["toctree"], page.count("/")

        def shared(**options: Any) -> str:
            key = (depth, *sorted(options.items()))
            if key not in made:
                made[key] = make(**options)
            return made[key]

        context["toctree"] = shared
