"""Exact solutions that the clutch is compared with.

================  ================================================================
``heated_plate``  a plate heated by a constant flux; average friction of a braking
================  ================================================================
"""
