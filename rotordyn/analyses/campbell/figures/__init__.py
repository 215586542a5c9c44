"""Figures: damped modes over speed and their critical speeds."""
