"""A model in one file that any browser shows: the compiled kernels, live, without a network.

==================  ============================================================================
``view``            what a model's page shows: data
``draws``           how a part scatters: draws that the page's scripts apply to its values
``sobol``           the points of those draws
``description``     a model as the page's scripts read it: inputs, parameters, kernels
``page``            which models have one; its file: template, styles, scripts, module
``washer_page``     the thrust washer's page
``clutch_page``     the wet clutch's page: an engagement under a ramp of load that one draws
``gearmesh_page``   the gear mesh's page: teeth and path of contact, temperatures
``losses_page``     the page of the driveline losses: heat by source over the speeds
``train_page``      the gear train's page: losses by source, bearings
``scene_data``      A scene as the page's scripts run it: parts, connections, profiles, draws
``scene_warnings``  what the page of a scene reads its warnings from: texts, limits
``scene_page``      the page of a scene: the whole shift in a browser
==================  ============================================================================

Styles and scripts lie in ``report/web/explore``, those of a model in its ``models``, put together
in ``report/web/bundle``.
"""
