"""Generated parts of the documents: each table between its two markers, and the figures.

``scripts/document`` runs it. No generated part is written by hand; no other text is changed.
"""
