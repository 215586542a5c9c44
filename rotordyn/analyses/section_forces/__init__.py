"""Section forces, deflection and stress of the shaft at rest."""
