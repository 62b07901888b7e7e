"""From the models' lists to FMUs: variables, XML, packing, checking."""
