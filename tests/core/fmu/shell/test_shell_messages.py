"""What the host is told: errors and warnings always, the rest when requested; once, in words."""

import math

import numpy as np
import pytest
from shell_runs import GUID, MADE, last, needs_gcc, putting, ref, run, taking, toy_library
from toy.spec import SPEC as TOY

from thrustwasher.errors import ParameterError, Status
from thrustwasher.fmu.running.direct_instance import DirectInstance

pytestmark = needs_gcc
both = pytest.mark.parametrize("fmi", [2, 3])
HOT = {"load": 8000.0, "speed": 900.0, "oil_temperature": 300.0}
COOL = {"load": 0.0, "speed": 0.0, "oil_temperature": 300.0}


def said(fmi, script, category=""):
    replies = run(fmi, toy_library(), script)
    return [m for r in replies for m in r.messages if category in m.split(" ")[2]]


def heated():
    """Return the script of a disc that gets too hot and cools down, and what the core says."""
    core = DirectInstance(TOY, parameters={"heat_capacity": 1.0})
    core.initialize(inputs=HOT)
    script, events, efforts = putting(heat_capacity=1.0) + "enter 0\n" + putting(**HOT), [], []
    script += "leave\n"
    for i in range(20):
        inputs = HOT if i < 5 else COOL
        core.set_inputs(list(inputs.values()))
        core.step(i * 0.1, 0.1)
        events += core.core.events
        efforts.append(core.core.effort)
        script += putting(**inputs) + f"step {(i * 0.1).hex()} {(0.1).hex()}\n"
    return script, events, efforts


@both
def test_a_step_too_short_for_the_spacing_of_time_moves_nothing(fmi):
    """A master that halves and doubles its step leaves 1.1e-16 s at the end of a run."""
    names = ["time", "energy", "film_ratio"]
    script = MADE + "enter 0\n" + putting(**HOT) + "leave\nstep 0 1.3\n" + taking(names)
    script += f"step 1.3 {(1.1e-16).hex()}\n" + taking(names)
    *_, before, still, after = run(fmi, toy_library(), script)
    assert (still.status, still.messages) == (0, [])
    assert after.values == before.values and before.values[0] == 1.3
    core = DirectInstance(TOY)
    core.initialize(inputs=HOT)
    core.step(0.0, 1.3)
    held = core.outputs()
    core.step(1.3, 1.1e-16)
    assert core.outputs() == held


@both
def test_a_master_that_doubles_its_step_comes_to_the_end(fmi):
    """Steps grow until one is cut at 1.3 s, where sums leave a hair of time to go."""
    script, t, h, n = MADE + "enter 0\nleave\n", 0.0, 1e-3, 0
    while t < 1.3 and n < 100:
        h = min(2.0 * h, 0.3, 1.3 - t)
        script, t, n = script + f"step {t.hex()} {h.hex()}\n", t + h, n + 1
    script += f"step {t.hex()} {math.ulp(t) / 2:.17g}\n"
    assert {r.status for r in run(fmi, toy_library(), script)} == {0}


START = 1.7e9  # seconds since 1970


@both
@pytest.mark.parametrize("h", [1e-3, 0.01])
@pytest.mark.parametrize(("start", "kept"), [(START, float), (0.1, float), (0.1, np.float32)])
def test_time_counted_from_a_late_start_or_in_single_precision_is_no_jump(fmi, start, kept, h):
    times = [float(kept(start + i * h)) for i in range(300)]
    script = (
        MADE.replace(" 1\n", " 0\n") + f"setup {times[0].hex()}\nenter {times[0].hex()}\nleave\n"
    )
    script += "".join(f"step {t.hex()} {h.hex()}\n" for t in times)
    assert [m for r in run(fmi, toy_library(), script) for m in r.messages] == []


@both
def test_a_true_jump_of_time_is_said_once_with_both_times(fmi):
    script = f"make toy {GUID} 0\nsetup {START.hex()}\nenter {START.hex()}\nleave\n"
    script += "".join(f"step {(START + 0.011 * i).hex()} {(0.01).hex()}\n" for i in range(5))
    (told,) = said(fmi, script)
    assert told.endswith(
        "step from t = 1700000000.011 s, but the last one ended at 1700000000.01 s; the host's "
        "time counts, and this is said once"
    )


@both
def test_a_value_outside_by_rounding_is_the_end_of_the_range(fmi):
    """The core's; 1e-9 of the range is too much."""
    low = 233.15
    for given, taken in ((math.nextafter(low, 0.0), low), (low - 1e-7, None), (low, low)):
        script = MADE + putting(oil_temperature=given) + taking(["oil_temperature"])
        *_, put, got = run(fmi, toy_library(), script)
        assert put.status == (3 if taken is None else 0)
        assert taken is None or got.values == [taken]
        core = DirectInstance(TOY).core
        reference = [ref("oil_temperature")]
        if taken is None:
            with pytest.raises(ParameterError, match="is outside 233"):
                core.set(reference, [given], "Real")
        else:
            core.set(reference, [given], "Real")
            assert core.get(reference, "Real") == [taken]


# What a C library writes under a language with a decimal comma, and under one with U+066B.
FOREIGN = """
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
static inline int foreign(char *to, size_t room, const char *format, va_list values)
{
    char plain[4096], *out = plain + 2048;
    int n = 0;
    vsnprintf(plain, 2048, format, values);
    for (const char *c = plain; *c; c++) {
        int sign = *c == '.' && (strstr(format, "%g") || strstr(format, "%.*")) && c > plain
            && c[-1] >= '0' && c[-1] <= '9';
        n += sprintf(out + n, "%.*s", sign ? (int)strlen(SIGN) : 1, sign ? SIGN : c);
    }
    snprintf(to, room, "%s", out);
    return n;
}
static inline int foreign_snprintf(char *to, size_t room, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    int n = foreign(to, room, format, values);
    va_end(values);
    return n;
}
static inline double foreign_strtod(const char *text, char **end)
{
    char plain[64] = {0}, *sign = strstr(text, SIGN);
    (void)end;
    if (!sign) return strtod(text, NULL);
    snprintf(plain, sizeof plain, "%.*s.%s", (int)(sign - text), text, sign + strlen(SIGN));
    return strtod(plain, NULL);
}
#define vsnprintf foreign
#define snprintf foreign_snprintf
#define strtod foreign_strtod
"""


@pytest.mark.parametrize("sign", [",", "\\xd9\\xab"], ids=["comma", "arabic"])
@pytest.mark.slow
def test_numbers_have_a_point_whatever_the_language_of_the_host(sign, tmp_path):
    (tmp_path / "foreign.h").write_text(f'#define SIGN "{sign}"\n{FOREIGN}')
    library = toy_library(
        ("-O1", "-Wno-error", "-w", "-D_GNU_SOURCE", "-include", str(tmp_path / "foreign.h"))
    )
    script = (
        MADE
        + "setup 0x1p-1\nenter 0x1p-1\nleave\nstep 0x1p-1 0x1p-2\n"
        + putting(oil_temperature=24.5)
        + "step 0x1p-1 0x1p-2\nstep 0x1p-1 nan\n"
    )
    plain, found = (
        [m for r in run(2, one, script) for m in r.messages] for one in (toy_library(), library)
    )
    assert found == plain and any("0.5 s" in m for m in plain)


@both
def test_events_are_told_once_and_as_the_core_words_them(fmi):
    script, events, _ = heated()
    told = said(fmi, MADE + script, "logEvents")
    assert [m.split("logEvents ")[1] for m in told] == events
    assert ["too hot" in e for e in events] == [True, False]
    assert "film_ratio = " in events[0] and "load = 8000 N" in events[0]


@both
def test_what_the_solver_took_is_told_in_every_step(fmi):
    script, _, efforts = heated()
    told = said(fmi, MADE + script, "logNonlinearSystems")
    assert [m.split("logNonlinearSystems ")[1] for m in told] == efforts
    assert "substeps: 1" in efforts[0]


@both
def test_advice_is_a_warning_given_once_also_to_hosts_that_log_nothing(fmi):
    told = said(fmi, f"make toy {GUID} 0\n" + heated()[0])
    assert len(told) == 1 and told[0].startswith(
        "1 toy logStatusWarning ToyClutch at t = 0.1 s: HOT"
    )
    assert Status.HOT.advice in told[0]


@both
def test_a_category_can_be_chosen_and_all_can_be_switched_off(fmi):
    script = heated()[0]
    kinds = {m.split(" ")[2] for m in said(fmi, MADE + "choose 1 logEvents\n" + script)}
    assert kinds == {"logEvents", "logStatusWarning"}
    kinds = {m.split(" ")[2] for m in said(fmi, MADE + "choose 0 logEvents\n" + script)}
    assert kinds == {"logNonlinearSystems", "logStatusWarning"}
    assert {m.split(" ")[2] for m in said(fmi, MADE + "choose 0\n" + script)} == {
        "logStatusWarning"
    }
    quiet = f"make toy {GUID} 0\n"
    assert len(said(fmi, quiet + "choose 1\n" + script)) == len(said(fmi, MADE + script)) == 23


@both
def test_an_unknown_category_is_named_and_changes_nothing(fmi):
    script = MADE + "choose 1 logEvents logNonsense#\n"
    reply = last(fmi, script)
    assert reply.status == 3 and "logNonsense# of" in reply.messages[0]
    assert len(said(fmi, script + heated()[0])) == 24


@both
def test_a_text_is_itself_the_format_of_the_message_with_its_signs_of_percent_doubled(fmi):
    """The host formats what it is given, as printf does."""
    reply = last(fmi, MADE + "choose 1 100%s#%n\n")
    assert "there is no category 100%s#%n of messages" in reply.messages[0]


@both
def test_errors_are_told_to_a_host_that_has_switched_logging_off(fmi):
    reply = last(fmi, f"make toy {GUID} 0\nenter 0\nleave\n" + putting(oil_temperature=24.0))
    assert reply.messages == [
        "3 toy logStatusError oil_temperature = 24 K is outside 233.15 .. 473.15 K; the value is "
        "not taken over. Did you mean 297.15 K (24 degC)?"
    ]


def test_what_is_too_long_is_cut_between_letters():
    """Letters of two, three and four bytes; the host here decodes strictly."""
    for letter in "ä\u20ac\U0001f600":
        for before in ("", "a", "aa", "aaa"):
            name = before + letter * 80
            told = last(2, f"make {name} {GUID} 0\nchoose 1 {name}\n").messages[0]
            _, shown, _, text = told.split(" ", 3)
            assert name.startswith(shown) and 124 <= len(shown.encode()) <= 127
            cut = text.removeprefix("there is no category ").split(" ")[0]
            assert name.startswith(cut) and 61 <= len(cut.encode()) <= 64


@both
def test_a_name_may_be_missing_or_too_long(fmi):
    long = last(fmi, f"make {'n' * 500} {GUID} 0\nstep 0 1\n").messages[0].split(" ")[1]
    assert set(long) == {"n"}
    assert last(fmi, f"make - {GUID} 0\nstep 0 1\n").messages[0].split(" ")[1] in (
        "ToyClutch",
        "NULL",
    )
