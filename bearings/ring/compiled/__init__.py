"""The same equations compiled, one state after the other: for single states in loops.

Why two solvers stand side by side (``docs/benchmarks.md``). Without this one a state in a loop
takes 1.2 (warm) to 6.5 ms (cold) for 55 to 58 µs, a ball of a cold batch 3.7 to 6.2 µs for 2.1 to
3.7 µs, one of a sweep 0.5 to 0.6 µs. Without the batched one every process would load this one for
0.44 s, as long as all solve stages of the flagship together, and the first would compile for 22 s,
where a state in numpy takes 5 ms.
"""
