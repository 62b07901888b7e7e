"""The gallery: pictures, each made by the code that is shown next to it."""

from pathlib import Path

HEAD = "# Gallery\n\nEach picture is made by the code below it, when this site is built.\n"
# Title, a sentence, code whose last name is `figure`.
PICTURES = (
    (
        "The washer's load curve with its folds",
        "Between the two folds a washer has three answers at one load; the middle one is unstable.",
        """
from thrustwasher import WasherParams, load_curve

figure = load_curve(WasherParams(), speed=545.0, tilt=0.002).plot()
""",
    ),
    (
        "Film, pressure and temperature over a washer",
        "The tilted washer carries at its narrow side; cavitation ends the film behind it.",
        """
from thrustwasher import WasherParams, solve_washer

figure = solve_washer(WasherParams(), load=300.0, speed=953.0, tilt=0.002).plot()
""",
    ),
    (
        "Friction over speed",
        "At one load, from boundary friction at rest through mixed friction to a full film.",
        """
import matplotlib.pyplot as plt
import numpy as np
from thrustwasher import WasherParams, run_sweep

speeds = np.geomspace(1.0, 2000.0, 60)
table = run_sweep("washer", over={"speed": speeds}, at={"load": 100.0, "tilt": 0.002})
figure, axis = plt.subplots(figsize=(8, 4), layout="constrained")
axis.semilogx(table["speed"], table["friction_coefficient"])
axis.set(xlabel="speed [rad/s]", ylabel="friction coefficient")
""",
    ),
    (
        "A clutch engages",
        "The load rises in 0.1 s while the slip falls: squeezed film, then asperities, then heat.",
        """
import numpy as np
from thrustwasher import ClutchParams, engage_clutch

time = np.linspace(0.0, 1.0, 401)
load, speed = np.minimum(time / 0.1, 1.0) * 5000.0, 200.0 * np.maximum(1.0 - time / 0.9, 0.0)
figure = engage_clutch(ClutchParams(), time=time, load=load, speed=speed).plot()
""",
    ),
    (
        "A gear mesh",
        "Temperatures over the numbers of teeth, and what they leave of the steels' endurance.",
        """
from thrustwasher import GearMeshParams, solve_gearmesh

figure = solve_gearmesh(GearMeshParams(), power=18e3, speed=300.0).plot()
""",
    ),
    (
        "What oil, bearings, seals and the pump take",
        "Heat by source while all shafts turn faster together.",
        """
from thrustwasher import LossesParams, solve_losses

speeds = {"input_speed": 300.0, "output_speed": 200.0, "planet_speed": 400.0}
figure = solve_losses(LossesParams(), **speeds, tooth_force=2000.0).plot()
""",
    ),
    (
        "Uncertainty is a washer?",
        "What nobody knows exactly makes a band of each figure.",
        """
from thrustwasher import propagate

figure = propagate("washer", at={"load": 300.0, "speed": 953.0}, runs=64).plot()
""",
    ),
    (
        "A shift",
        "Power-on upshift: the phases are shaded, events are numbered.",
        """
from thrustwasher import run_shift

figure = run_shift("planetary").plot()
""",
    ),
)


def write_gallery(folder: Path) -> None:
    """Run the code, write the pictures and the page that shows both."""
    images, lines = folder / "gallery", [HEAD]
    images.mkdir(parents=True, exist_ok=True)
    for number, (title, words, code) in enumerate(PICTURES, 1):
        names: dict[str, object] = {}
        exec(compile(code, f"<gallery: {title}>", "exec"), names)  # what is shown is what ran
        names["figure"].savefig(images / f"{number}.png", dpi=110)  # type: ignore[attr-defined]
        lines += [f"## {title}", words, f"![{title}](gallery/{number}.png)"]
        lines += [f"```python\n{code.strip()}\n```"]
    (folder / "gallery.md").write_text("\n\n".join(lines) + "\n", encoding="utf-8")
