"""The choice of a rung, and the tables of measured errors that it rests on.

=================  ============================================================================
``choose``         Choose the cheapest rung that holds a tolerance over a box of inputs
``compare_rungs``  How far a rung is from the one above at points, where no table speaks
``error_table``    Tables of measured errors: how far each rung is off in which region
``formats``        How errors are written for a person
``own_tables``     A map of one's own part: built unless one is kept that serves
=================  ============================================================================
"""
