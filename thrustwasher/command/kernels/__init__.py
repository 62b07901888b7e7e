"""Compiled code of the command source.

========  ==================================================================================
``step``  The course of a shift command: a ramp between two values, a function of time alone
========  ==================================================================================
"""
