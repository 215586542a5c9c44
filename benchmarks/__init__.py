"""What the main job costs, measured with the standard library; see ``docs/benchmarks.md``."""
