"""Pictures of the rotor in space, rendered in another process: see ``apart``."""
