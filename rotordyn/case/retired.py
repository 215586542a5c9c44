"""Keys of earlier versions, and what a case does without them."""

from __future__ import annotations

# By the entry that held the key and its name: the sentence that a file with it gets.
RETIRED: dict[tuple[str, str], str] = {
    ("conditions", "shaft"): (
        "`shaft` is no longer a key: the shaft is one of elements, refined until the accuracy "
        "asked for holds; leave it out, and ask for accuracy: 1e-8 instead of exact"
    ),
    ("frf", "method"): (
        "`method` is no longer a key: responses are those of the reduced model, with an estimate "
        "of its error; leave it out"
    ),
}
