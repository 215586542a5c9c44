"""Figures: steady response to unbalance."""
