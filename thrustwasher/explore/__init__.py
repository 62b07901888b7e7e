"""A model in one file that any browser shows: the compiled kernels, live, without a network.

===============  ==================================================================
``view``         what a model's page shows: data
``draws``        how a part scatters: draws that the page's scripts apply to its values
``description``  a model as the page's scripts read it: inputs, parameters, kernels
``page``         which models have one; the file: template, styles, scripts, module, still pictures
``washer_page``  the thrust washer's view; ``gearmesh_page``, ``clutch_page``: the others'
===============  ==================================================================

Styles and scripts lie in ``report/web/explore``.
"""
