"""From the models' lists to FMUs, and FMUs at work.

=====================  =============================================================================
``registry``           which models there are, their kernels, the digest of their content
``interface``          the one list of variables per model
``xml_parts``          units, types and attributes as both FMI versions write them
``model_description``  the XML files of both versions
``sources``            where the models' own files lie; the GUID
``build``              everything in one FMU; ``archive`` packs it
``native``             libraries that need no Python: kernels behind a shell in C
``slave``              the Python FMU; ``python_contents``: what it carries
``page``               documentation of ``wiring``, ``markup``, ``licences``; ``reference``: results
``core``               a running model; ``snapshot``: its state; ``direct``: it without an FMU
``stepper``            FMU instances through FMPy: ``loading``, ``protocol``
``doctor``             what works on this machine
=====================  =============================================================================
"""
