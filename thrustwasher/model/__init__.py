"""What a model is, and the one list of models.

=================  ===============================================================================
``input_courses``  Checked courses of inputs over time
``kernel_tables``  Tables that a rung reads: they lie behind the work of its kernel
``parameters``     One field, one source: the metadata feeds checks, FMU variables, command line
                   and docs
``prepare``        From a parameter dataclass to the array a kernel takes
``recent``         What belongs to a parameter object, kept while that very object is used again
                   and again
``registry``       The models and their kernels by name
``rules``          Rules between parameters: the kernel tests them, the texts here say which one
                   is broken
``spec``           What a model shows to the outside: inputs, outputs, parameters, kernel; as data
``tailored``       A model with other defaults: the same kernels and names, the numbers of one
                   place of use
``work_arrays``    Per-thread work arrays for kernels, kept alive between calls
=================  ===============================================================================
"""
