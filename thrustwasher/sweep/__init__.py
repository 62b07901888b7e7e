"""Many operating points at once: on all cores or on a cluster, resumable, one table at the end.

===========  =====================================================================================
``axes``     what is varied: texts such as ``50:1850:50`` into values
``plan``     the rows in their order, cut into lines that are solved one point after the other
``rows``     solves lines; runs in the workers
``table``    the rows as columns, as CSV or Parquet
``run``      ``run_sweep``: lines handed to processes here or to a Dask cluster
===========  =====================================================================================
"""
