"""The same equations compiled, one state after the other: for single states in loops."""
