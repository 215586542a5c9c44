"""The rotor as a body: its surface, its motion in a mode, the orbits of its axis."""
