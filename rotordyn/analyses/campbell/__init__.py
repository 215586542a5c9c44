"""Damped modes over speed and their critical speeds."""
