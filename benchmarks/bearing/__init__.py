"""What solving one bearing costs, and what accuracy costs there; see ``docs/benchmarks.md``."""
