"""The bearing solver on very large random sets:  python -m benchmarks.random_bearings."""
