"""Building and checking the washer's map: charts of solutions for look-up."""
