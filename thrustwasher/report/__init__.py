"""Plots and the report of a shift."""
