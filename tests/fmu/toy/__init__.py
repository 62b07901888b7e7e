"""A cheap model with everything an FMU can have: memory, every type of variable, every failure."""
