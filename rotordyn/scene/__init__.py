"""A machine at its speeds: operating states, equation of motion, free motions, solved once."""
