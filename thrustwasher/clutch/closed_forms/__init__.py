"""Exact solutions that the clutch is compared with.

================  ==============================================================================
``heated_plate``  A friction plate: heated by a constant flux on its face; average friction of a
                  braking
================  ==============================================================================
"""
