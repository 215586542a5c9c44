"""Shared parts of the figures of all analyses: style, curves, legends, the half-section."""
