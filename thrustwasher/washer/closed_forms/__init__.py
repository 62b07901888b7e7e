"""Exact solutions that the washer is compared with.

===============  =============================================================================
``heated_ring``  thin annuli heated unevenly around the circumference, or in a stack of three
``thin_film``    films between disc and plate: parallel, across a narrow ring, slightly tilted
===============  =============================================================================
"""
