"""The gear mesh at the start of contact.

================  ==============================================================================
``closed_forms``  Exact and published solutions that the gear mesh is compared with
``kernels``       Compiled code of the gear mesh
``parameters``    Parameters of the gear mesh: one spur pair, its surfaces, oil, steel and the
                  laws to apply
``solve``         Gear mesh: temperatures, contact and thermal stress where contact starts, loss
                  of the mesh
================  ==============================================================================
"""
