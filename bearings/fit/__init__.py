"""Rings on a shaft: growth of the grooves by interference, rotation and temperature."""
