"""Which race controls the balls of a single bearing."""
