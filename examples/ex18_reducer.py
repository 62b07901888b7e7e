"""A reducer of an electric car: what it loses, driving and coasting, and what bounds it."""

from pathlib import Path

from thrustwasher.train.train_file import load_train
from thrustwasher.train.train_map import train_map

SCENE = Path(__file__).with_name("ev-reducer.toml")


def main() -> float:
    found = train_map(load_train(SCENE), torque=[-150.0, 150.0], speed=[500.0])
    c = found.columns
    for i, way in enumerate(found.flow):
        print(f"{c['torque'][i]:g} N m: {way}, efficiency {100.0 * c['efficiency'][i]:.2f} %")
        for name in ("first.loss", "second.loss", "bearing_loss", "seal_loss", "churning_loss"):
            print(f"  {name:14} {c[name][i]:6.1f} W")
        print(f"  minimum life of a bearing {c['bearing_life'][i] / 3600.0:.0f} h")
    return float(c["efficiency"][1])


if __name__ == "__main__":
    main()
