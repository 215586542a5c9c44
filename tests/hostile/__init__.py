"""Files, machines and calls that no sensible user writes: a right result or one sentence."""
