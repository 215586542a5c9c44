"""Measurements of computing time, memory and accuracy; see ``docs/benchmarks.md``."""
