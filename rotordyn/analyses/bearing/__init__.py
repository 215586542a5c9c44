"""A single bearing over load and speed."""
