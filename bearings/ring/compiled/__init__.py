"""The same equations compiled, one state after the other: for single states in loops.

Two solvers stand side by side because each is several times faster than the other at its task: this
one for states in a loop and for sweeps, instead of the batched one, which needs no loading and no
compiling (measured times: ``docs/benchmarks.md``).
"""
