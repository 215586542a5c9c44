"""Standard elements of all six degrees of freedom a node, assembled and not reduced."""
