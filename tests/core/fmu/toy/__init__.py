"""A cheap model that can do and say all a model can, and fails on command; also written in C."""
