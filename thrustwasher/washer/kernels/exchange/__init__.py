"""The thrust washer for model exchange.

===========  ========================================================================
``kept``     what is discrete: places, and the solution kept from step to step
``branch``   the same branch of solutions, or the fold that ends it
``on_map``   the same by a map, and where the map is asked
``in_time``  heat in time: mean temperatures are states, between events
``shapes``   how the fields follow at events
``unit``     the functions that the host calls: a bristle, outputs, events, slopes
===========  ========================================================================
"""
