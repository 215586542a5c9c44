"""What results are: declared arrays, their printed units and lines of text."""
