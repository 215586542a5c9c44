"""The same equations compiled and solved state by state: for single states in loops.

There are two solvers because each is faster than the other at its task: this one, 2 to 10 times,
for states in a loop and for sweeps, the batched one where loading or compiling would cost more
(measured times: ``docs/benchmarks.md``).
"""
