"""Tables of measured data as spreadsheets, loggers and programs write them."""
