"""Commands of the studio, a file each, and what ``shift`` has of it.

=================  =========================================================
``_shift_report``  report, pictures, table and live page of a shift
``_study_target``  options that name a part or a scene, with its point
``_traces``        recordings over time as ``calibrate`` takes them
``calibrate``      fit parameters of a model to measured outputs, or a friction law
``compare``        measurements of others against what the models say
``efficiency``     what a gearbox loses in a gear, by source, over torque and speed
``explore``        one file in which a part or a shift is tried in a browser
``fidelity``       measured error and cost of each fidelity level; of your own part too
``optimise``       the best part, load curve or gear shift under limits, or a front
``scatter``        uncertainty of the figures of a part or a gear shift
``sweep``          a model over all combinations of inputs and parameters
=================  =========================================================
"""
