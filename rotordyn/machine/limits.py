"""Pressures that ball contacts withstand [Pa]."""

# ISO 76: at 4.2 GPa the permanent dent of a ball bearing reaches 1e-4 of the ball diameter.
WARNING_PRESSURE = 4.2e9
# Preloads of spindle bearings, heavy classes too, press their balls to 1 to 1.8 GPa at rest.
PRELOAD_PRESSURE = 2.0e9
# Far beyond any elastic contact of hardened steel: results there would mean nothing.
HIGHEST_PRESSURE = 10e9
