"""The simplest SSP master: reads the description, exchanges values, steps all parts at once.

It knows nothing of scenes and parts, only what stands in the package.
"""

import io
import zipfile
from xml.etree.ElementTree import fromstring

SSP = "http://ssp-standard.org/SSP1/SystemStructure"
NS = {"ssd": f"{SSP}Description", "ssc": f"{SSP}Common", "ssv": f"{SSP}ParameterValues"}
EXCHANGES = 6  # before the first step


def description(package, name="SystemStructure.ssd"):
    """Return the root of a description in a package, given as bytes or path."""
    source = io.BytesIO(package) if isinstance(package, bytes) else package
    with zipfile.ZipFile(source) as archive:
        return fromstring(archive.read(name))


def components(root):
    return {c.get("name"): c for c in root.findall("ssd:System/ssd:Elements/ssd:Component", NS)}


def connections(root):
    """Return (element, connector, element, connector) of each; None: the system's border."""
    keys = ("startElement", "startConnector", "endElement", "endConnector")
    found = root.findall("ssd:System/ssd:Connections/ssd:Connection", NS)
    return [tuple(c.get(key) for key in keys) for c in found]


def values(component):
    """Return the values bound to a component, numbers as numbers."""
    convert = {"Real": float, "Integer": int, "Boolean": lambda t: t == "true", "Enumeration": str}
    found = {}
    for p in component.findall(".//ssv:Parameter", NS):
        kind = p[0].tag.rpartition("}")[2]
        found[p.get("name")] = convert[kind](p[0].get("value"))
    return found


def bound(root):
    """Return the values of all components: their own, and those connected to the system's."""
    system = root.find("ssd:System", NS)
    above = values(system.find("ssd:ParameterBindings", NS))
    found = {name: values(part) for name, part in components(root).items()}
    for source, given, target, into in connections(root):
        if source is None and given in above:
            found[target][into] = above[given]
    return found


def run(root, instances, wires=None, start=None):
    """Step the instances over the default experiment; return all outputs at its end by name.

    ``start``: another start time [s], for a run of the same length.

    ``wires``, (part, output, part, input, factor), stand in place of the package's connections.

    Before each step values are passed on until they agree, as by OMSimulator's fixed-step master,
    which reads every output after it has set the inputs it depends on.
    """
    experiment = root.find("ssd:DefaultExperiment", NS)
    begin, stop = float(experiment.get("startTime")), float(experiment.get("stopTime"))
    start, span = begin if start is None else start, stop - begin
    h = float(experiment.find(".//*[@baseStepSize]").get("baseStepSize"))
    inner = [w for w in connections(root) if w[0] is not None and w[2] is not None]
    wires = wires or [(*w, 1.0) for w in inner]
    inputs = {n: dict.fromkeys(i.input_names, None) for n, i in instances.items()}
    for name, instance in instances.items():
        given = bound(root)[name]
        inputs[name] = {key: given[key] for key in instance.input_names}
        instance.initialize(start, inputs[name])
    outputs = {}

    def exchange():
        for name, instance in instances.items():
            outputs[name] = dict(zip(instance.output_names, instance.outputs(), strict=True))
        for source, output, target, into, factor in wires:
            inputs[target][into] = factor * outputs[source][output]

    def put():
        for name, instance in instances.items():
            instance.set_inputs(list(inputs[name].values()))

    for i in range(round(span / h)):
        for _ in range(EXCHANGES):
            exchange()
            put()
        for instance in instances.values():
            instance.step(start + i * h, h)
    exchange()
    return {f"{p}.{n}": x for p, found in outputs.items() for n, x in found.items()}
