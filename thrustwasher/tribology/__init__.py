"""What several subjects share: films, asperities, viscosity, heat of a body.

========================  ========================================================================
``asperities``            elasto-plastic asperities: the force of one, the pressure of many
``bristle``               friction at rest and in sliding by one state, for model exchange
``contact_table``         knots of Greenwood & Tripp's F_5/2, kept in a file
``flow_factors``          rough surfaces: mean gap, flow, shear flow factor, squeezing
``greenwood_tripp``       contact of a rough lining: Greenwood & Tripp's integrals
``greenwood_williamson``  real contact area of rough surfaces: F_1 and the area ratio
``holding``               units that hold between two shafts of a driveline they do not know
``lumped_body``           a body that is heated and cooled: its temperature after a time, exactly
``viscosities``           viscosity at several temperatures side by side
``viscosity``             viscosity of the oil over temperature, with its slope
========================  ========================================================================
"""
