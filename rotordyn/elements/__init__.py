"""Local matrices: numbers in, small arrays out; no node numbers, no speed."""
