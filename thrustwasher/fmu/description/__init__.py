"""The model description of an FMU.

=====================  ===========================================================
``interface``          one list of variables per model
``model_description``  modelDescription.xml and terminalsAndIcons.xml
``groups``             groups of parameters, for tools that show a tree
=====================  ===========================================================
"""
