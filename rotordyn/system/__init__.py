"""The rotor as a whole: mesh, order of freedoms, assembled matrices."""
