#!/usr/bin/env bash
# What:   a message that a Python slave of pythonfmu logs in a step that then fails, in FMPy.
# Guess:  FMPy's logger prints it like any other message.
# Seen:   with Python 3.13 the logger fails: "Exception ignored on calling ctypes callback function
#         .. SystemError: .. returned a result with an exception set". pythonfmu empties its queue of
#         messages while the slave's exception is still pending, and Python code that runs then
#         fails at the first call of C that returns a value. With Python 3.11 the message comes.
#         The FATAL message that follows says "unknown error" in both.
# Matters to who writes a logger, or a slave that says why before it raises: the text that tells
#         the reason is the one that may not come.
# Version: pythonfmu 0.7.0, FMPy 0.3.32, Python 3.13 and 3.11
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cat >"$dir/slave.py" <<'PY'
from pythonfmu import Fmi2Causality, Fmi2Slave, Real
from pythonfmu.enums import Fmi2Status


class Heater(Fmi2Slave):
    author = "nobody"
    description = "a limit that is told"

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.temperature = 300.0
        self.register_variable(Real("temperature", causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        self.temperature += 60.0
        if self.temperature > 400.0:
            self.log("too hot for the law", Fmi2Status.error)
            raise ValueError("temperature = 420 K, allowed: up to 400 K")
        return True
PY
cat >"$dir/drive.py" <<'PY'
import sys

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

path = sys.argv[1]
described, folder = read_model_description(path), extract(path)
fmu = FMU2Slave(
    guid=described.guid, unzipDirectory=folder, instanceName="heater",
    modelIdentifier=described.coSimulation.modelIdentifier,
)
fmu.instantiate(loggingOn=True)
fmu.setupExperiment(startTime=0.0)
fmu.enterInitializationMode()
fmu.exitInitializationMode()
for k in range(2):
    try:
        fmu.doStep(0.1 * k, 0.1)
    except Exception as problem:
        print("doStep:", problem, flush=True)
PY
status=0
for minor in 11 13; do
    python=$(ls "$HOME/.pyenv/versions/3.$minor."*/bin/python3 2>/dev/null | tail -n 1)
    "${python:-python3.$minor}" -m venv "$dir/v$minor" || exit 2
    "$dir/v$minor/bin/pip" install --disable-pip-version-check pythonfmu==0.7.0 fmpy==0.3.32 \
        setuptools >"$dir/log" 2>&1 || { cat "$dir/log" >&2; exit 2; }
    (cd "$dir" && "$dir/v$minor/bin/pythonfmu" build -f slave.py -d "$dir/f$minor" >"$dir/log" 2>&1) ||
        { cat "$dir/log" >&2; exit 2; }
    "$dir/v$minor/bin/python" "$dir/drive.py" "$dir/f$minor/Heater.fmu" >"$dir/out$minor" 2>&1 || true
    echo "Python 3.$minor, pythonfmu 0.7.0, FMPy 0.3.32:"
    sed 's/^/    /; s/0x[0-9a-f]*/0x../' "$dir/out$minor"
done
failed="returned a result with an exception set"
grep -q "too hot for the law" "$dir/out11" && ! grep -q "$failed" "$dir/out11" || status=1
grep -q "$failed" "$dir/out13" || status=1
grep -q "doStep:.*fatal" "$dir/out11" && grep -q "doStep:.*fatal" "$dir/out13" || status=1
[ $status = 0 ] && echo "as described" || echo "CHANGED"
exit $status
