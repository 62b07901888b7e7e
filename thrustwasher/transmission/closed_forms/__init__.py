"""Exact solutions that the planetary set is compared with.

=======================  =========================================================================
``lock_up``              inertias locked by a clutch; the first gear of Modelica's SimpleGearShift
``planetary``            kinematics and tooth forces with helical gears
``torsional_stability``  slip before an elastic shaft: where falling friction feeds judder
=======================  =========================================================================
"""
