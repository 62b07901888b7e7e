"""Run the commands of thrustwasher with the journal bearing as a further model."""

from thrustwasher.model.registry import MODELS

MODELS["journal"] = "journal"

if __name__ == "__main__":
    from thrustwasher.cli import main

    raise SystemExit(main())
