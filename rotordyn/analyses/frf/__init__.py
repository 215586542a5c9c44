"""Frequency responses between points, beside measured ones."""
