"""The same equations compiled, one state after the other: for single states in loops.

What that gains over the batched solver (``docs/benchmarks.md``): a state in a loop takes 55 to
58 µs instead of 1.2 (warm) to 6.5 ms (cold); a ball of a cold batch 2.1 to 3.7 µs instead of 3.7 to
6.2 µs, one of a sweep 0.5 to 0.6 µs.
"""
