"""A bearing from printed catalogue values: plausible internal geometries, and the estimate."""
