"""A bearing from what a catalogue prints: values, the insides that explain them, the estimate."""
