"""Tables of measured data as spreadsheets, loggers and programs write them.

==================  ============================================================================
``table_file``      a table of any file, by its kind
``heads``           where tables stand: heads of names with rows of numbers under them
``text_file``       tables in text: code page, separator
``decimal_signs``   decimal points or commas, groups of thousands
``spreadsheet``     sheets of a workbook
``matlab_file``     vectors of a MATLAB file or of a struct in it
``measuring_file``  channels of a measuring file, each over times of its own
``parquet_file``    columns of a Parquet file
``kinds``           kinds of files, and those that are refused
``table``           columns with names, units and cells
``column_names``    columns renamed, summed and subtracted
``known_columns``   columns that count, and what unknown ones probably hold
``given``           a table as Python's users hand it over: path, DataFrame, MDF
==================  ============================================================================
"""
