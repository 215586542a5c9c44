"""What the machine is: frozen descriptions in SI units, no matrices, no files."""
