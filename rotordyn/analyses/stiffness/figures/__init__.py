"""Figures: radial stiffness of a point by bearing model."""
