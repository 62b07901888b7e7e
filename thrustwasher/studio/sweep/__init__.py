"""Many operating points at once: on all cores or on a cluster, resumable, one table at the end.

===============  =================================================================================
``axes``         What is varied: texts such as ``50:1850:50`` into values
``csv_text``     Rows as the text of a CSV file
``run_sweep``    A whole sweep, from what is varied to its table
``run_plan``     The rows of a sweep of engagements, shifts or a function
``sweep_plan``   The rows in their order, cut into lines that are solved one point after the other
``sweep_table``  The rows as columns, as CSV or Parquet
===============  =================================================================================
"""
