"""FMUs that need no Python: compiled kernels behind a shell in C.

===========  =======================================================================================
``calls``    which FMI function may be called when
``tables``   a model as C source
``library``  shell and kernels linked for each platform
===========  =======================================================================================
"""
