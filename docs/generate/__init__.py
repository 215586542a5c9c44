"""Writes what the documents state in numbers: each table between its two markers, and the figures.

``scripts/document`` runs it. Nothing in a generated part is written by hand, nothing outside one is
touched.
"""
