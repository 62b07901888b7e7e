"""Exact and published solutions that the gear mesh is compared with.

=====================  ================================================================
``involute_mesh``      where two gears touch first, how flanks move, what sliding costs
``line_contact``       two cylinders: Hertz's contact, its oil film, friction of flanks
``flash_temperature``  heat of a sliding contact: flash temperature, shear of the film
``thermal_fatigue``    contact stress borne beside thermal shocks (Atan 2005, Eq 8-12)
=====================  ================================================================
"""
