"""The choice of a level, and the tables of measured errors that it rests on.

=================  ============================================================================
``choose``         Choose the cheapest level that holds a tolerance over a box of inputs
``compare_levels``  How far a level is from the one above at points, where no table speaks
``error_table``    Tables of measured errors: how far each level is off in which region
``formats``        How errors are written for a person
``own_tables``     The map of a part of your own: built unless one is kept that serves
=================  ============================================================================
"""
