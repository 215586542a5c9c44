"""The README by its sections: front page, user guide, accuracy."""

from __future__ import annotations

import re

FRONT, GUIDE, ACCURACY = SECTION_PAGES = ("index", "guide", "accuracy")
LEFT_OUT = ""
# Sections not named here belong to the guide; those left out have a document of their own.
PAGE_OF = {
    "Set up and run": FRONT,
    "How accurate": ACCURACY,
    "How fast": LEFT_OUT,
    "Where things are": LEFT_OUT,
}
TITLES = {GUIDE: "User guide", ACCURACY: "Published beside computed"}


def readme_pages(text: str) -> dict[str, str]:
    """Markdown of each page that sections of the README make, by name of the page."""
    head, *parts = re.split(r"^## (?=\w)", text, flags=re.M)
    pages = {FRONT: head} | {page: f"# {title}\n\n" for page, title in TITLES.items()}
    for part in parts:
        page = PAGE_OF.get(part.partition("\n")[0], GUIDE)
        if page != LEFT_OUT:
            pages[page] += f"## {part}"
    return pages
