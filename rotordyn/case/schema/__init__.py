"""The shape of each kind of file: which keys there are, which values they take."""
