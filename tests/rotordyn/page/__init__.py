"""One HTML page of results: what it holds, and that it works in a browser."""
