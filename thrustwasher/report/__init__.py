"""Plots and the report of a shift.

==================  ================================================================
``palette``         colours told apart by everyone; ``style``: one look for all plots
``washer_plots``    maps of film, pressure and temperature; the load curve with its folds
``clutch_plot``     friction of a pack against slip speed; an engagement over time
``fit_plot``        measured friction, the law fitted to it, residuals
``gearmesh_plot``   temperatures and stress factors of a gear mesh over its teeth
``shift_record``    what the report needs from a finished shift; ``rungs``: of its rungs
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
