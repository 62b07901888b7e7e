"""Plots and the report of a shift.

``style``          colours, line widths, empty figures: one look for all plots
``washer_plots``   maps of film, pressure and temperature over the washer
``curve_plot``     the washer's load curve with its folds
``clutch_plot``    friction of a pack against slip speed
``fit_plot``       measured friction, the law fitted to it, residuals
``gearmesh_plot``  temperatures and stress factors of a gear mesh over its teeth
``shift_record``   what the report needs from a finished shift
``panel_base``     what panels over time share: lines, phases, events
``panels``         single panels over time: speeds, torques, temperatures
``film_panels``, ``energy_panels``, ``stress_panels``, ``friction_panels``, ``judder_panels``: more
``shift_plots``    the figures made of them
``washer_moment``  the washer solved again at one moment of the shift
``extremes``       the worst values of a shift and when they were reached
``trust``          how far to trust it, in sentences
``judder``         what to say of a shaft that swings; ``chatter``: of a slip that flips
``summary``        what happened, in sentences made from the numbers
``tables``         the report's tables as rows of text; ``rung_section``: the chapter on rungs
``shift_report``   all of that as the chapters of a page
``html``           one self-contained page
=================  =================================================================
=======
==================  ================================================================
``palette``         colours told apart by everyone; ``style``: one look for all plots
``washer_plots``    maps of film, pressure and temperature; the load curve with its folds
``clutch_plot``     friction of a pack against slip speed; an engagement over time
``fit_plot``        measured friction, the law fitted to it, residuals
``gearmesh_plot``   temperatures and stress factors of a gear mesh over its teeth
``shift_record``    what the report needs from a finished shift
``moments``         its worst values and when they were; the washer solved again there
``panel_base``      what panels over time share: lines, phases, events
``panels``          single panels: speeds, torques, temperatures, energy, a swinging shaft
``contact_panels``  more: oil films, friction, tooth stress
``shift_plots``     the figures made of them
``findings``        what to say of a tie-up, of judder, of a slip that flips
``summary``         what happened, in sentences made from the numbers
``trust``           how far to trust it, in sentences
``tables``          the report's tables as rows of text; ``rung_section``: the chapter on rungs
``shift_report``    all of that as the chapters of a page
``html``            one self-contained page
``chart_page``      the charts of speed against accuracy as a page, from its JSON record;
                    ``chart_cost``: their drawings, ``chart_text``: their words
``stability_page``  where methods fail, as a page and as a map
==================  ================================================================
"""
