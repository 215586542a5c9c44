"""The axial arrangement of shaft, sleeves, springs and stops, and its state at every speed."""
