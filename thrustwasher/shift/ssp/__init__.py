"""A shift as a System Structure and Parameterization (SSP 1.0) package, for any SSP master.

====================  =============================================================================
``changed_values``    a scene with other values, as ``shift --ssp --set`` asks for
``system_structure``  components, connections and outputs of the system
``package``           the files of the package but the FMUs: SystemStructure.ssd and a page
====================  =============================================================================
"""
