"""A shift as a System Structure and Parameterization (SSP 1.0) package, for any SSP master.

====================  =============================================================================
``system_structure``  components, connections and outputs of the system
``structure_xml``     SystemStructure.ssd
``package``           the files of the package but the FMUs, and their page of documentation
====================  =============================================================================
"""
