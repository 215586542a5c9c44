"""The equation of motion of a machine: assembled from terms, reduced, given at any speed."""
