"""Algorithms that know no rotor: eigenproblems, modes followed over a parameter, sparse sums, threads."""
