"""The load at which a thrust washer loses its oil film, and the one at which it gets it back."""

from thrustwasher import WasherParams, load_curve


def main() -> float:
    curve = load_curve(WasherParams(), speed=545.0, tilt=0.002)
    for fold in curve.folds:
        print(
            f"{fold.kind:14} {fold.load:7.1f} N   film ratio {fold.film_ratio:5.2f}   "
            f"{fold.temperature - 273.15:6.1f} degC   {fold.friction_torque:.3f} N m"
        )
    for point in curve.points[:: max(1, len(curve.points) // 12)]:
        print(f"{point.branch:9} {point.load:8.1f} N  {point.friction_torque:8.4f} N m")
    return next(fold.load for fold in curve.folds if fold.kind == "film_lost")


if __name__ == "__main__":
    main()
