"""The files inside an FMU and their sources.

=================  ======================================================================
``licences``       our licence, and a notice for each part that comes from others
``model_sources``  where the FMUs' own sources lie, and the GUID made of all that goes in
=================  ======================================================================
"""
