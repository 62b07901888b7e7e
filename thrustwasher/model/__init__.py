"""What a model is, and the one list of models.

===============  ===============================================================================
``spec``         what a model shows to the outside: inputs, outputs, parameters, kernel; as data
``record``       all that the rest of the package knows of a model
``registry``     the models and their kernels by name
``parameters``   fields with unit, range and meaning; checks of numbers and profiles over time
``part_file``    your own parts and presets: TOML
``advice``       warnings of a solution, one line each
``idle``         parameters without effect, or kept though what they belong to was changed
``point``        an operating point: what is given, fixed by the box, left to the defaults
``quantity``     what is given, with unit and range; what comes out
``scatter``      laws of what is known within bounds only: tables ``[scatter]``, draws, correlation
``unread``       which parameters are not read, because of the value of another one
``oil``          an oil by name, data sheet or points, as parameters of a model
``oil_laws``     viscosity of an oil over temperature: ASTM D341, and the laws that the models have
``levels``        names of levels, and which one runs in the place of one that is gone
``prepare``      from parameters to what a kernel takes: rules, constants, tables
``sensitivity``  derivatives of results over parameters, and differences where a solve is quick
``solutions``    solutions of a model, at a point and over time, as a person reads them
``toml_tables``  TOML files and their tables: read, with quantities in SI units
===============  ===============================================================================

Every model has one module ``kernels.step`` with the same face, the step ABI, so that Python, the
Python FMU and the native FMU call the same code:

=====================  ============================================================================
``N_PARAM``            parameters the caller fills in: dataclass fields in order, then the fidelity
``NPAR``               length of ``par``: the parameters, then constants that ``derive`` computes
``NINP .. NIOUT``      lengths of ``inp``, ``state``, ``work``, ``out``, ``iout``
``NRATES``             NINP where ``inp`` may have rates behind the inputs; else it is left out
``NSEED``              NINP and tunable parameters ``sens`` knows; left out where there are none
``RUN_START``          where in ``par`` the run's start [s] lies: ``instant`` ones count from it
``derive(par)``        fill ``par[N_PARAM:]``; return a status; called once per parameter change
``broken_rule(par)``   number of the first broken rule between parameters, 0 if there is none
``step(...)``          ``step(par, inp, state, work, out, iout, t, dt)`` returns a status
``sens(...)``          ``sens(par, inp, state, work, seed, dout)`` returns a status; not all have it
``W_TOLD``             where in ``work`` the numbers of ``errors.FIGURES`` lie, if it has them
``W_STATES``           where in ``work`` the states of model exchange lie, if not all are outputs
``TABLE``              where in ``work`` the table of a level lies, if one looks its answers up
=====================  ============================================================================

``par`` and ``inp`` are read only. ``state`` is all the memory there is (all zeros: no history); it
changes only if ``dt > 0`` and the step succeeds; with ``dt = 0`` the outputs at the present inputs
come back and ``state`` stays as it was to the bit. ``work`` belongs to the caller; whatever it
holds on entry, the result is the same. ``out`` holds the real outputs, ``iout`` (int32) the
enumerations and Booleans, both in the order of the model's list of outputs. A step that fails
leaves ``state`` as it was to the bit; ``out`` and ``iout`` may hold anything then.

With rates [unit/s] in ``inp[NINP:2 * NINP]`` an input has its value at the start of the step and
runs straight; ``out`` then belongs to the inputs at the end. Rates of 0, or an ``inp`` without
them, hold the inputs. From the FMU's shell ``inp`` always has them.

``sens`` fills ``dout`` with the change of the real outputs of a step with ``dt = 0`` when the
inputs change by ``seed`` and ``state`` is held; ``work`` must be as the last successful step with
these ``par``, ``inp`` and ``state`` left it, and may be used. Exact, no differences of solutions;
where the model has a corner, the side counts that the point is on.

``TABLE`` names ``AT``, ``ROOM`` (place and length of the table), ``MAGIC`` (its first number),
``SIZE`` (place of its length), ``PARAMS``, ``N_PARAMS`` (place and number of the parameters it was
made for), ``HEADER`` (how many of its numbers are doubles in a file), ``SWITCH``, ``ON`` (place in
``par`` and number of the fidelity that wants it).
"""
