"""Keys of earlier versions, and what a case does without them."""

from __future__ import annotations

# By the entry that held the key and its name: the sentence that a file with it gets.
RETIRED: dict[tuple[str, str], str] = {
    ("conditions", "shaft"): (
        "`shaft` is no longer a key: the shaft is modelled by finite elements, refined until the "
        "required accuracy is reached; leave it out, and give accuracy: 1e-8 instead of exact"
    ),
    ("frf", "method"): (
        "`method` is no longer a key: responses are those of the reduced model, with an estimate "
        "of its error; leave it out"
    ),
}
