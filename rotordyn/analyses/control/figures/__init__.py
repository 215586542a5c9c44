"""Figures: which race controls the balls of a single bearing."""
