"""Radial stiffness of a point by bearing model."""
