"""Where methods fail, and the limits of co-simulation.

===================  ============================================================================
``coupling_limits``  Steps and slopes at which a loop of two parts stops being stable
``failure_cells``    Cells of the stability map: what one method does at one hazard, measured
``failure_map``      The failure map: each method meets each hazard, and what comes out is judged
``failure_washer``   Where methods fail on the washer's equations: its balance, closed forms
``stability_page``   Where methods fail, as a page of Markdown and as a map of coloured cells
===================  ============================================================================
"""
