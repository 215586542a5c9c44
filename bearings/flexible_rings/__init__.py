"""Rings that deform under their balls, with the shaft or housing that backs them."""
