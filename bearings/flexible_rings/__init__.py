"""Rings that deform under their balls, with the shaft or housing they sit on."""
