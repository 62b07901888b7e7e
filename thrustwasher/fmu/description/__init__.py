"""The model description of an FMU.

=====================  ===========================================================
``interface``          one list of variables per model
``model_description``  modelDescription.xml and terminalsAndIcons.xml
``xml_parts``          what the descriptions of FMI 2.0 and FMI 3.0 have in common
=====================  ===========================================================
"""
