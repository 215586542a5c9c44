"""Figures: frequency responses between points, beside measured ones."""
