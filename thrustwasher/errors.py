"""What can go wrong, and how it is said."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from enum import IntEnum
from errno import EINVAL
from os import PathLike, fspath, stat
from stat import S_ISFIFO
from typing import TypeVar

T = TypeVar("T")


class ParameterError(ValueError):
    """An argument or parameter is outside the range the model holds for."""


class UnknownParameter(ParameterError, TypeError):
    """A parameter of this name is none; to Python it is a wrong keyword as well."""


class SolveError(RuntimeError):
    """No solution was found; the message says what was tried and what to change."""


class BranchError(ParameterError, SolveError):
    """The wanted solution branch does not exist at this operating point."""


class EnvironmentProblem(RuntimeError):
    """Something this machine lacks (a package, a writable folder); the message says what to do."""


class Suggesting(dict[str, T]):
    """What there is by name, with the names among them or for them that are suggested."""

    suggested: Iterable[str] = ()
    absent: Iterable[str] = ()
    """Names of what has no value here."""


def suggestion(
    name: str,
    known: Iterable[str],
    words: str,
    otherwise: str = "",
    *,
    likeness: float = 0.6,
    by_words: bool = True,
) -> str:
    """Return words with the known name in them that was probably meant, else the other ones.

    ``known``: names; of a ``Suggesting`` those it suggests, first one that ends with ``name``. Else
    first, ``by_words``, what has all words of the name among its own, as pinion_teeth has teeth; of
    several that are equally alike the first.
    """
    from difflib import SequenceMatcher  # late: it is for mistakes alone

    def parts(text: str) -> set[str]:
        return set(text.replace(".", "_").split("_"))

    names = list(getattr(known, "suggested", known))
    ends = [n for n in names if n.endswith((f"_{name}", f".{name}"))]
    if ends and hasattr(known, "suggested"):
        return words.format(ends[0])
    if (same := name.replace("factor", "scale")) != name and same in names:
        return words.format(same)

    def alike(other: str) -> float:
        return SequenceMatcher(None, other, name).ratio()

    longer = [other for other in names if parts(name) < parts(other) or other == name]
    if by_words and longer:
        return words.format(max(longer, key=alike))
    near = [other for other in names if alike(other) >= likeness]
    return words.format(max(near, key=alike)) if near else otherwise


@contextmanager
def naming(path: str | PathLike[str]) -> Iterator[None]:
    """Let an error of the disk, such as a full one, say which file it is about."""
    try:
        yield
    except OSError as error:
        if error.filename is None:
            error.filename = fspath(path)
        raise


def refuse_pipe(path: str | PathLike[str]) -> None:
    """Raise OSError for a named pipe, whose writer may never come; what lies in /dev is meant."""
    if S_ISFIFO(stat(path).st_mode) and not fspath(path).startswith("/dev/"):
        raise OSError(EINVAL, "is a pipe, a file is required", fspath(path))


@contextmanager
def within(where: str) -> Iterator[None]:
    """Let a ParameterError say in which file, table or part it arose."""
    try:
        yield
    except ParameterError as problem:
        raise ParameterError(f"{where}: {problem}") from None


class Status(IntEnum):
    """How a kernel ended, the more severe the larger; ``advice`` is the sentence the user needs.

    Numbers below ``FIRST_FAILURE`` are advice: the numbers returned are a solution.
    """

    advice: str
    OK = 0, "solved"
    OUTSIDE_VERIFIED = (
        1,
        "an input is outside the range the accuracy was verified for; use with care",
    )
    HOT = (
        2,
        "the contact is above 250 degC, too hot for oil and lining; lower load, speed or time",
    )
    DISTRESS = 3, "the oil film is lost (thermo-viscous distress); lower the load to regain it"
    STALLED = (
        4,
        "both packs hold: the driveline stands still or the engine stalls; release one pack",
    )
    CHATTER = (
        5,
        "the slip reverses again and again, the torque with it, or is the same to the bit over "
        "several steps: the speed is noisy, late or held for this step and driveline; step the "
        "unit where its speeds are new (held ones: each advised_step), take a shorter step, "
        "set holding = given with coupling_inertia and coupling_age, or let the host hold "
        "(torque_capacity)",
    )
    OUTSIDE_MAP = (
        6,
        "an input is outside the map's box: answered by `field` or at the box's nearest edge, as "
        "outside_map says",
    )
    UNANSWERED = (
        7,
        "the slip does not answer the torque: the pack slides with its capacity, right for a "
        "prescribed slip; else connect friction_torque, or the speed is too coarse for the step",
    )
    REFUTED = (
        8,
        "coupling_inertia and coupling_age do not explain the slip: the pack slides until it was "
        "open; of packs in parallel each takes the inertia times its share of the capacity",
    )
    EXTRAPOLATED = (
        9,
        "the contact is above 600 degC: the numbers are no more than an extrapolation; lower load, "
        "speed or time",
    )
    MAX_ITERATIONS = (
        10,
        "not converged; start from a neighbouring result or refine in smaller steps",
    )
    SINGULAR = 11, "the equations are singular here, as at a fold; move the load a little"
    NO_BRANCH = 12, "the wanted branch has no solution at this load; ask for the other branch"
    NO_EVENT = 13, "a lock-up or break-away could not be located; use a smaller communication step"
    NOT_FINITE = 14, "the computation left the range of numbers; check parameters and inputs"
    BAD_INPUT = (
        15,
        "an input is not finite, outside its range, or excluded by another one given",
    )
    OVER_BUDGET = (
        16,
        "the work that one solution may take is spent; come from a neighbouring result, in smaller "
        "steps, or move the point",
    )
    NOT_IN_MAP = (
        17,
        "an input is outside the map's box; keep to the box, build a map for a larger one, or set "
        "outside_map = hold or solve",
    )
    TOO_HOT = (
        18,
        "slip that lasts heats the contact above 600 degC, beyond any model of it; lower load or "
        "speed, cool better, or follow it over time",
    )

    def __new__(cls, code: int, advice: str = "") -> "Status":
        """Keep the number as the value and the sentence next to it."""
        status = int.__new__(cls, code)
        status._value_, status.advice = code, advice
        return status

    @property
    def is_failure(self) -> bool:
        """True when the numbers that came with it are only a best estimate."""
        return self >= FIRST_FAILURE


FIRST_FAILURE = 10

# What is said with a status of a unit that cannot hold: the first sentence whose number is not 0;
# numbers in braces are places among those that the unit tells (``M.T_...`` of holding.memory).
FIGURES = (
    (
        Status.UNANSWERED,
        0,
        "tested {0} times, none answered; the noise of the speed is {1} rad/s, the capacity moves "
        "the slip by at most {2} rad/s in a step",
    ),
    (Status.CHATTER, 5, "the speed comes every {5} steps: step the unit at that rate"),
    (
        Status.CHATTER,
        2,
        "the noise of the speed is {1} rad/s, the torque moves it by at most {2} rad/s in a step",
    ),
    (Status.REFUTED, 7, "the slip answers as one of {7} kg m2 does"),
    (
        Status.REFUTED,
        4,
        "the slip is {3} rad/s where at most {4} rad/s were expected",
    ),
    (
        Status.REFUTED,
        2,
        "the noise of the speed is {1} rad/s, the torque moves it by at most {2} rad/s in a step",
    ),
)


def figures_of(status: Status, numbers: list[float]) -> str:
    """Return what ``FIGURES`` says of a status with a unit's numbers, "" if it has none here."""
    for named, place, text in FIGURES if numbers else ():
        if named is status and numbers[place] > 0.0:
            return text.format(*(f"{x:g}" for x in numbers)) + "; "
    return ""
