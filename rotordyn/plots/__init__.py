"""Figures from results; the only package that knows matplotlib, and only when one is drawn."""
