"""What the figures of all analyses share: style, curves, legends, the half-section."""
