"""How right each rung of a model is, what it costs, and which one to take."""
