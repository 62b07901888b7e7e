"""Pictures of shifts over time.

=================  =======================================================
``overview_plot``  a shift in one picture: speeds, torques, film ratios
``sequence_plot``  several shifts: temperatures of oil and packs, speeds
=================  =======================================================
"""
