"""Shape functions and matrices of beams and rods of any degree."""
