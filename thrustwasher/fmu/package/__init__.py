"""The files inside an FMU and their sources.

=================  ===============================================================================
``archive``        A zip with the same bytes for the same content: sorted and undated
``licences``       documentation/licenses of an FMU: ours, and one notice for each part that comes
                   from others
``model_sources``  Where the FMUs' own sources lie, and the GUID made of all that decides an FMU's
                   content
=================  ===============================================================================
"""
