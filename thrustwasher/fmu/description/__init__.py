"""The model description of an FMU.

=====================  ===========================================================================
``interface``          One list of variables per model: everything an FMU shows comes from here
``model_description``  modelDescription.xml of FMI 2.0 and 3.0, and terminalsAndIcons.xml, from a
                       model's lists
``xml_parts``          What the descriptions of FMI 2.0 and FMI 3.0 have in common; each spells it
                       its own way
=====================  ===========================================================================
"""
