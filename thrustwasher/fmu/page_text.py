"""The sentences of the page inside an FMU that are the same for every model, by target."""

STYLE = """body{font:16px/1.5 system-ui,sans-serif;max-width:60em;margin:2em auto;padding:0 1em;
color:#263242}table{border-collapse:collapse;width:100%;margin:1em 0}
td:nth-child(3){min-width:7em}
th,td{border:1px solid #c4ccd4;padding:.25em .5em;text-align:left;vertical-align:top}
th{background:#eef1f4}code,pre{background:#f4f6f8}pre{padding:1em;overflow:auto;font-size:14px}
svg{max-width:100%;height:auto}"""

NEEDS = {
    "native": """<p>Nothing but the C library of the operating system (Linux: glibc 2.17 or later,
with libm; Windows 10 or later: what comes with it). No Python, no compiler, no further file; 64-bit
processes only. Inside are libraries for {platforms}. Any number of instances may run, in any
number of threads, one call at a time per instance.</p>""",
    "python": """<p>This FMU runs in Python: the importing process must be, or find, a Python with
the package <code>thrustwasher</code> of version {version}
(<code>pip install thrustwasher=={version}</code>). Another version is refused at instantiation with
a message that names both. The first run on a machine compiles the model, which takes seconds to
minutes; later runs load the result.</p>""",
}

FAILS = {
    "native": """<ul>
<li>A value outside its range, NaN, infinity or an unknown reference: the call returns an error and
takes nothing over. The message names variable, value, unit and range, <code>solver_status</code>
shows BAD_INPUT, and the next step is refused until a good value is set.</li>
<li>A step without a solution leaves everything as it was before the step and returns an error (not
Discard). <code>solver_status</code> and the message say why. The instance stays usable: a step with
better input works again.</li>
<li>A call in the wrong order returns an error that names the call to make first.</li>
<li>A library of another build than the description is refused when it is instantiated.</li>
<li>No call returns OK with a number that is none. Nothing is written to the screen; messages go to
the host's logger: errors and warnings always, the rest by category.</li>
<li>The complete state can be saved, restored and serialized; a continued run is equal to the
bit.</li>
<li>Values read after setting an input, without a step, are those at the new input; reading never
changes what follows.</li>
</ul>""",
    "python": """<ul>
<li>A value outside its range, NaN, infinity or an unknown reference: the call returns an error and
takes nothing over. The message names variable, value, unit and range, <code>solver_status</code>
shows BAD_INPUT, and the next step is refused until a good value is set.</li>
<li>A step without a solution leaves every value as it was before the step and returns an error (not
Discard). <code>solver_status</code> and the message say why. A step with better input works
again.</li>
<li>Where no Python with the package is found, there is no instance, and the message says what to
do.</li>
<li>On Windows, or when this file was built without a C compiler (see externalDependencies.txt), the
library that returns these errors is missing: only a step can fail there, and returns Discard. Look
at <code>solver_status</code>.</li>
<li>The complete state can be saved, restored and serialized.</li>
<li>Values read after setting an input, without a step, are those at the new input.</li>
</ul>""",
}

CHECK = """<p>Simulate the default experiment with the inputs of
<code>{folder}/{model}_in.csv</code> (linear between the rows, those at the beginning of a step hold
during it) and compare with <code>{model}_out.csv</code> beside it.</p>"""

HOSTS = {
    "native": (
        ("linux64", "run: FMPy and a C host, bit-equal to the Python API on the same machine"),
        ("win64", "run under wine; not run on Windows itself"),
        ("aarch64-linux", "run in an emulator (qemu); not run on a board"),
        ("darwin-x86_64, darwin-arm64", "linked, never run"),
        ("Simulink, Dymola, OpenModelica, Amesim, real-time targets", "not run"),
        ("a host that is a 32-bit process", "not offered"),
    ),
    "python": (
        ("Linux, x86-64", "run: FMPy and a C host"),
        ("Windows, x86-64", "pythonfmu's library is inside; not run"),
        ("other platforms", "not offered; use target native"),
    ),
}
UNSIGNED = """<p>The libraries are not signed: a virus scanner or Windows itself may block a file
that came from the internet. Unblock the FMU in its properties before you unpack or import it, or
build it yourself from the sources: the same version and compilers give the same bytes.</p>"""
