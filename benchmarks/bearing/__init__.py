"""Computing time and accuracy of the solution of one bearing; see ``docs/benchmarks.md``."""
