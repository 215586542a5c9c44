"""Rings on a shaft: interference, rotation and temperature give the growth of the grooves."""
