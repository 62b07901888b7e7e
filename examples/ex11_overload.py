"""How long may a washer be overloaded? Its bodies store heat, so the film is lost later."""

import numpy as np

from thrustwasher import WasherParams, follow_washer, load_curve

AT = {"speed": 545.0, "tilt": 0.002}
TIME = np.linspace(0.0, 10.0, 401)


def main() -> list[float]:
    fold = load_curve(WasherParams(), **AT).folds[0].load
    print(f"steady states lose the film at {fold:.0f} N, at once")
    washer, lost = WasherParams(thermal_mode="transient"), []
    for share in (1.05, 1.2, 1.5):
        load = np.where(TIME > 0.0, share * fold, 0.8 * fold)
        history = follow_washer(washer, time=TIME, load=load, **AT)
        lost.append(float(history.time[np.argmax(history.distress)]))
        print(
            f"{share * fold:5.0f} N: lost after {lost[-1]:5.2f} s, "
            f"{history.temperature[-1] - 273.15:.0f} degC after {TIME[-1]:.0f} s"
        )
    return lost


if __name__ == "__main__":
    main()
