"""Steady response to unbalance."""
