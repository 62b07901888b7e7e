"""How the FMUs hold a driveline, judged from outside: plants, sensors, traces and gearboxes.

Written from the documentation, without the law. ``python -m lab.benchmarks.holding.judge`` drives
the built FMUs; ``--help`` lists the options.
"""
