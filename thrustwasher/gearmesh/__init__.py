"""The gear mesh at the start of contact.

================  ============================================================================
``model``         its record
``parameters``    a spur pair, its surfaces, oil, steel and the laws to apply; inputs, outputs
``solve``         temperatures, contact, thermal stress where contact starts; loss of the mesh
``closed_forms``  exact and published solutions that it is compared with
``kernels``       compiled code
================  ============================================================================
"""
