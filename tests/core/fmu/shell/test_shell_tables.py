"""The generated tables: complete, exact, and C whatever stands in a sentence."""

import re
from importlib import metadata
from pathlib import Path

import pytest
from shell_runs import GUID, MADE, needs_gcc, run, taking, toy_library
from toy.spec import SPEC as TOY

from thrustwasher.fmu.description.interface import interface
from thrustwasher.fmu.package.model_sources import source_folder
from thrustwasher.fmu.shell import c_tables, call_table
from thrustwasher.model.spec import tailored

HEADERS = Path(str(metadata.distribution("fmpy").locate_file("fmpy"))) / "c-code"


@pytest.mark.parametrize(("fmi", "number"), [(2, 44), (3, 75)])
def test_the_table_of_calls_has_every_function_of_the_standard(fmi, number):
    text = (HEADERS / f"fmi{fmi}Functions.h").read_text("utf-8", "replace")
    standard = set(re.findall(rf"FMI{fmi}_Export \w+\s+(fmi{fmi}\w+);", text))
    assert set(call_table.functions(fmi)) == standard and len(standard) == number


def test_a_part_has_the_tables_of_its_model_and_a_file_of_its_own():
    part = tailored(TOY, {"discs": 5, "fidelity": "fine"}, {"load": 7.0}, name="Mine")
    assert c_tables.sources(interface(part)) == c_tables.sources(interface(TOY))
    assert c_tables.part_file(interface(part), GUID) != c_tables.part_file(interface(TOY), GUID)
    assert c_tables.part_file(interface(TOY), GUID) != c_tables.part_file(interface(TOY), "other")


def test_every_file_is_there():
    shell = source_folder() / "shell"
    assert all((shell / name).is_file() for name in c_tables.SHELL_FILES)


def test_sentences_become_c_whatever_they_hold():
    assert (
        c_tables._text('a "b" \\ ??) 20 °C') == '"a \\042b\\042 \\134 \\077\\077) 20 \\302\\260C"'
    )
    assert c_tables._text(None) == "0"


@needs_gcc
@pytest.mark.parametrize("fmi", [2, 3])
def test_numbers_reach_c_to_the_bit(fmi):
    found = [v for v in interface(TOY).variables if v.causality in ("input", "parameter")]
    replies = run(fmi, toy_library(), MADE + taking([v.name for v in found]))
    got = sorted(x for r in replies for x in r.values)
    assert got == sorted(v.start for v in found)
