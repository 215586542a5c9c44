"""Algorithms that know no rotor: eigenproblems, followed modes, sparse sums, threads."""
