"""What several subjects share: films, asperities, viscosity, heat of a body.

========================  ======================================================================
``asperities``            Elasto-plastic asperities: the force of one, and the pressure of many
                          over the separation
``flow_factors``          Film functions of rough surfaces: mean gap, flow, shear flow factor,
                          squeezing; with slopes
``greenwood_tripp``       Contact of a rough lining: Greenwood & Tripp's integrals over the
                          heights
``greenwood_williamson``  Real contact area of rough surfaces: Greenwood & Williamson's F_1 and
                          the area ratio
``lumped_body``           A lumped body that is heated and cooled: its temperature after a time,
                          exactly
``viscosity``             Viscosity of the oil over temperature, with its slope
========================  ======================================================================
"""
