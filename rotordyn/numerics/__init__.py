"""Algorithms that know no rotor: small dense eigenproblems and modal sums, batched over speed."""
