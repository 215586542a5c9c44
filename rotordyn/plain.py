"""Replace symbols by ASCII, for terminals and file formats that have nothing else."""

from __future__ import annotations

import codecs
import re
import unicodedata

HANDLER = "rotordyn.plain"  # name of the error handler for characters that a stream lacks
_SYMBOLS = {
    "µ": "u",
    "μ": "u",
    "→": "->",
    "←": "<-",
    "×": "x",
    "−": "-",
    "–": "-",
    "·": "*",
    "⋅": "*",
    "…": "...",
    "≤": "<=",
    "≥": ">=",
    "≈": "~",
    "±": "+-",
    "°": "deg",
    "√": "sqrt",
    "∞": "infinity",
    "½": "1/2",
    "′": "'",
    "’": "'",
    "“": '"',
    "”": '"',
    "├": "|",
    "│": "|",
    "└": "`",
    "─": "-",
    "━": "-",
    "\xa0": " ",
}
_RAISED = re.compile("[⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ⁿ]+")


def plain(text: str) -> str:
    """Convert ``text`` to ASCII: symbols become words or signs, other letters Python escapes.

    Letters do not merely lose their accent: a path must not look like that of another file.

    >>> plain("2 µm → 3·10⁻⁶ m, Δα, Noël")
    '2 um -> 3*10^-6 m, Deltaalpha, No\\\\xebl'
    """
    raised = _RAISED.sub(lambda run: "^" + _compatible(run.group()), text)
    return "".join(letter if letter.isascii() else _letter(letter) for letter in raised)


def register() -> None:
    """Register ``HANDLER`` as an error handler of encodings."""
    codecs.register_error(HANDLER, _encode)


def _letter(letter: str) -> str:
    if letter in _SYMBOLS:
        return _SYMBOLS[letter]
    words = unicodedata.name(letter, "").split(" ")
    if words[0] == "GREEK" and words[-2:-1] == ["LETTER"]:
        name = words[-1].replace("LAMDA", "LAMBDA")
        return name.capitalize() if "CAPITAL" in words else name.lower()
    return letter.encode("ascii", "backslashreplace").decode("ascii")


def _compatible(raised: str) -> str:
    return unicodedata.normalize("NFKD", raised).replace("−", "-")


def _encode(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return plain(error.object[error.start : error.end]), error.end
