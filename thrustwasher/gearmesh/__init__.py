"""The gear mesh: loss and heat along the path of contact, or at its start as in the paper.

================  ============================================================================
``parameters``    a pair, its surfaces, oil, steel and the laws to apply; inputs, outputs
``solve``         loss, heat, temperatures, contact, thermal stress, safety
``kernels``       compiled code
================  ============================================================================
"""
