"""The report of a shift, chapter by chapter.

=====================  ==========================================================================
``rung_section``       The report's section on rungs: which ran, why, how far off they were and
                       what was run again
``shift_record``       What the report needs from a finished shift, as plain data
``shift_report``       The report of a shift: what was simulated, what came out, how far to trust
                       it
``shift_tables``       The report's tables as rows of text
``summary``            What happened in a shift, in sentences made from its numbers
``trust``              How far a run is to be trusted, in sentences
``warnings_in_words``  What to say where packs work against each other, a shaft swings or a slip
                       flips
``worst_moments``      The worst values of a shift, when they were reached, and the washer solved
                       again there
=====================  ==========================================================================
"""
