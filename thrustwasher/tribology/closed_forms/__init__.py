"""Exact and published solutions that several subjects are compared with.

================  ================================================================================
``greenwood``     Elastic contact of rough surfaces: Greenwood & Williamson, Greenwood & Tripp for
                  two sides
``squeeze_film``  Oil squeezed from between smooth annular faces under a constant load, in closed
                  form
================  ================================================================================
"""
