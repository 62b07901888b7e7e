"""Exact and published solutions that the gear mesh is compared with.

=====================  ==========================================================================
``flash_temperature``  Heat of a sliding line contact: flash temperature of a deep body, shear of
                       the oil film
``involute_mesh``      Where two involute spur gears touch first, how their flanks move there,
                       what sliding costs
``line_contact``       Two long cylinders pressed together: Hertz's contact, its oil film,
                       friction of gear flanks
``thermal_fatigue``    Contact stress that a flank bears while thermal shocks strain it too (Atan
                       2005, Eq 8-12)
=====================  ==========================================================================
"""
