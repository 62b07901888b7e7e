"""Two small linear FMUs for loops whose limits are known: a body that moves, a law that answers."""
