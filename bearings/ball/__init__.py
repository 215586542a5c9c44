"""One ball between its grooves: the forces of its contacts and its motion on it and the rings."""
