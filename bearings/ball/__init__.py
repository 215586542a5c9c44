"""One ball between its grooves: what its contacts and its motion do to it and to the rings."""
