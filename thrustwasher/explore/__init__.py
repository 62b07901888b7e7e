"""A model in one file that any browser shows: the compiled kernels, live, without a network.

===============  ==================================================================
``view``         what a model's page shows: data, named by the model's record
``description``  a model as the page's scripts read it: inputs, parameters, kernels
``page``         the file: template, styles, scripts, module, still pictures
``washer_page``  the thrust washer's view; ``gearmesh_page``, ``clutch_page``: the others'
===============  ==================================================================

Styles and scripts lie in ``report/web/explore``.
"""
