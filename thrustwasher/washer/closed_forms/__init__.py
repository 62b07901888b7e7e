"""Exact solutions that the washer is compared with.

===============  =================================================================================
``heated_ring``  Thin annuli that are heated: unevenly around the circumference, or in a stack of
                 three
``thin_film``    Films between a disc and a plate: parallel, across a narrow tilted ring, slightly
                 tilted
===============  =================================================================================
"""
