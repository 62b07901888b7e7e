"""Many jobs, each done once: here until processes pay, then on all cores, or on a cluster.

===========  ====================================================================
``runner``   hands jobs out and takes their answers in; restarts what died
``cluster``  the workers of a running Dask cluster
``rows``     rows of numbers that jobs fill in, with their journal and progress
``progress`` what shows the progress of a call
===========  ====================================================================
"""
