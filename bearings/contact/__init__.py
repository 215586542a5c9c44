"""One contact of a ball: Hertz' solution."""
