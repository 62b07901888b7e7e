"""The gear shift: scenes, co-simulation masters, energy book."""
