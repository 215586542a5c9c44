"""Variants of a case in one figure."""
