"""A pack fitted to recordings of its engagements, by what ``traces`` does for all models.

================  ===========================================================
``recorded``      recordings as they are given, completed
``traced_pack``   a pack with the test rig that records it over time
``pack_history``  it is stepped along a recording
``slip_scatter``  scatter of a slip that was found by the recorded torque
``trace_fit``     ``calibrate_traces``: parameters from recordings
================  ===========================================================
"""
