"""Pictures of the rotor in space. They are rendered in another process: see ``apart``."""
