"""One contact of a ball: Hertz' solution, the ellipse and where its edge lies."""
