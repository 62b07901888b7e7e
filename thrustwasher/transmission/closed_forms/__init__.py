"""Exact solutions that the planetary set is compared with.

=======================  =========================================================================
``lock_up``              Two inertias locked together by a clutch, and the first gear of
                         Modelica's SimpleGearShift
``planetary``            Simple planetary set with helical gears: kinematics and tooth forces in
                         closed form
``torsional_stability``  A clutch that slips before an elastic shaft: where falling friction feeds
                         the torsional mode
=======================  =========================================================================
"""
