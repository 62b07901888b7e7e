"""The shift under a master that chooses its step by doubling, as PyFMI and MasterSim do.

Hazard: values need several exchanges from the command to the packs and back; what two halves of a
    step and the whole differ by is then the same however short the step, and the step goes to 0.
Cure: the transmission takes a change of its inputs in proportion to a step that is shorter than the
    last ones.
"""

import pytest
from scene_runs import slow_without_jit

from lab.benchmarks.error_controlled import StepDoubling, drive, structure
from thrustwasher.errors import ParameterError
from thrustwasher.fmu.running.direct_instance import DirectInstance
from thrustwasher.shift import load_scene
from thrustwasher.shift.ssp.system_structure import prepared

pytestmark = slow_without_jit


def system(stop):
    return structure(prepared(load_scene("planetary").with_options(stop_time=stop)))


def instances(found):
    return {c.name: DirectInstance(c.spec, parameters=c.parameters) for c in found.components}


@pytest.mark.parametrize("order", ["parallel", "serial"])
@pytest.mark.parametrize("rtol", [1e-3, 1e-4])
@pytest.mark.slow
def test_the_step_stays_above_a_microsecond_where_the_packs_begin_to_be_pressed(order, rtol):
    found = system(0.15)
    run = drive(found, instances(found), rtol=rtol, order=order)
    assert run.shortest > 1e-6
    assert run.refused < 1.5 * run.taken


@pytest.mark.slow
def test_a_master_that_never_agrees_is_told_where_its_step_becomes_0():
    found = system(0.15)

    disturbed = [k.input for k in found.links].index("clutch_torque")

    class NeverContent(StepDoubling):
        count = 0

        def settled(self, values, sent):
            self.count += 1
            values[disturbed] += 10.0 * (self.count % 3)
            return values

    master = NeverContent(instances(found), found.links, rtol=1e-3)
    master.initialize(0.0, {c.name: c.starts for c in found.components})
    with pytest.raises(ParameterError, match=r"by 0\.0 s, allowed: finite, step > 0"):
        master.run(0.05, 0.15)
