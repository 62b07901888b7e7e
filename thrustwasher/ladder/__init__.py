"""The rungs of a model: their cards, and the choice of a rung.

==============  ================================================================================
``boxes``       Boxes of inputs: what is asked of one, what part lies inside another
``candidates``  Rungs with fresh cards, what they promise over boxes and cost, and plans
``card``        Cards: the verified error and the cost of one rung, chart and parameter set
``card_parts``  The parts of a card: what was verified, where, against what, and what it cost
``choose``      Choose the cheapest rung that holds a tolerance over a box of inputs
``own_tables``  A map of one's own parameters, built with its cards where that pays
``formats``     How errors, times and shares are written for a person
==============  ================================================================================
"""
