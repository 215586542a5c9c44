"""Figures: a single bearing over load and speed."""
