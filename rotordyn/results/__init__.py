"""Results: declared arrays, their printed units and lines of text."""
