"""The rotor as a body to look at: its surface, how it moves in a mode, the orbits of its axis."""
