"""The model description of a plain journal bearing."""

from thrustwasher.model.record import Command, Model


class Journal(Model):
    """A plain journal bearing."""

    key = "journal"
    wiring = ("Subtract friction_torque from the torque of the shaft.",)
    command = Command(
        help="friction and film of a plain journal bearing at one operating point",
        title="journal bearing",
        examples=(
            'thrustwasher journal --load "1 kN" --speed "3000 rpm"',
            "thrustwasher journal --load 500 --set clearance=20e-6 --json",
        ),
    )

    @property
    def spec(self):
        from journal.parameters import SPEC

        return SPEC

    @property
    def solve(self):
        from journal.solve import solve_journal

        return solve_journal


MODEL = Journal()
