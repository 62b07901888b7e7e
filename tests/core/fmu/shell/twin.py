"""The same calls on the Python core and, as a script, on the shell: answers to compare."""

from itertools import groupby

from shell_runs import LETTERS

from thrustwasher.errors import ParameterError, SolveError
from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.running.core import Core, Mode

ERROR = 3


class Twin:
    """Keeps what the core answered next to the script that asks the shell the same."""

    def __init__(self, spec, guid):
        self.spec, self.script, self.expected = spec, "", []
        self.core, self.states = Core(interface(spec)), {}
        self.variables = {v.name: v for v in interface(spec).variables}
        self._ask(f"make twin {guid} 0", lambda: None)

    def _ask(self, command, answer):
        """Add one command; ``answer`` gives the core's values or raises."""
        self.script += command + "\n"
        try:
            self.expected.append((0, answer() or [], ""))
        except (ParameterError, SolveError) as problem:
            self.expected.append((ERROR, [], str(problem)))

    def _groups(self, names):
        """Return (type, variables) in the order hosts have to ask: by type."""
        found = sorted(
            (self.variables[n] for n in names), key=lambda v: list(LETTERS).index(v.type)
        )
        return [(kind, list(group)) for kind, group in groupby(found, key=lambda v: v.type)]

    def put(self, **values):
        for kind, found in self._groups(values):
            given = [float(values[v.name]) for v in found]
            pairs = " ".join(f"{v.reference} {x.hex()}" for v, x in zip(found, given, strict=True))
            references = [v.reference for v in found]
            self._ask(
                f"put {LETTERS[kind]} {pairs}",
                lambda r=references, g=given, k=kind: self.core.set(r, g, k),
            )

    def move(self, **rates):
        """Set rates of inputs; FMI 2 only."""
        found = [(self.variables[name].reference, float(x)) for name, x in rates.items()]
        pairs = " ".join(f"{reference} {x.hex()}" for reference, x in found)
        self._ask(f"put derivative {pairs}", lambda: self.core.set_rates(*zip(*found, strict=True)))

    def take(self, names=None):
        early = self.core.mode == Mode.INSTANTIATED  # the shell says that outputs come later
        known = [v.name for v in self.variables.values() if v.causality != "output" or not early]
        for kind, found in self._groups(names or known):
            references = [v.reference for v in found]
            self._ask(
                f"take {LETTERS[kind]} {' '.join(map(str, references))}",
                lambda r=references, k=kind: self.core.get(r, k),
            )

    def begin(self, start=0.0):
        self._ask(f"setup {start!r}", lambda: None)
        self._ask(f"enter {start!r}", lambda: self.core.begin(start))

    def leave(self):
        self._ask("leave", lambda: self.core.leave_initialization())

    def step(self, t, h):
        self._ask(f"step {float(t).hex()} {float(h).hex()}", lambda: self.core.advance(t, h))

    def reset(self):
        self._ask("reset", lambda: setattr(self, "core", Core(interface(self.spec))))

    def save(self, slot):
        self._ask(f"save {slot}", lambda: self.states.update({slot: self.core.snapshot()}))

    def restore(self, slot):
        self._ask(f"restore {slot}", lambda: self.core.restore(self.states[slot]))

    def check(self, replies, words=True):
        """Assert that every answer of the shell is the core's: status, bits of values, sentence."""
        assert len(replies) == len(self.expected)
        commands = self.script.splitlines()
        for command, reply, (status, values, text) in zip(
            commands, replies, self.expected, strict=True
        ):
            assert (reply.status, reply.values) == (status, values), command
            errors = [m for m in reply.messages if m.startswith("3 ")]
            said = [m.split(" ", 3)[3] for m in errors]
            assert not words or said == ([text] if text else []), command
