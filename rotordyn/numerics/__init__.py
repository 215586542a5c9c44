"""Algorithms that know no rotor: eigenproblems, eliminations and following, dense and sparse."""
