"""Constants of SKF's model of bearing friction by type and series.

Source: SKF, *Rolling bearings* (PUB BU/P1 10000 EN, 2013), chapter on friction, tables 2: as
publicly transcribed, more than once and alike; the catalogue itself was not at hand.
Units of the catalogue: N, mm, mm2/s, 1/min, N mm.
"""

BALL, ANGULAR, CYLINDRICAL, TAPER = range(1, 5)  # types
# Series -> what it stands for; type, R1, R2, R3, S1, S2, S3 (0: the type has none).
TABLE: dict[str, tuple[str, tuple[float, ...]]] = {
    "60": ("deep groove ball 60, 630", (BALL, 4.1e-7, 1.7, 0.0, 3.73e-3, 14.6, 0.0)),
    "62": ("deep groove ball 62, 622", (BALL, 3.9e-7, 1.7, 0.0, 3.23e-3, 36.5, 0.0)),
    "63": ("deep groove ball 63, 623", (BALL, 3.7e-7, 1.7, 0.0, 2.84e-3, 92.8, 0.0)),
    "64": ("deep groove ball 64", (BALL, 3.6e-7, 1.7, 0.0, 2.43e-3, 198.0, 0.0)),
    "160": ("deep groove ball 160, 161", (BALL, 4.3e-7, 1.7, 0.0, 4.63e-3, 4.25, 0.0)),
    "618": ("deep groove ball 618, 628", (BALL, 4.7e-7, 1.7, 0.0, 6.5e-3, 0.78, 0.0)),
    "619": ("deep groove ball 619, 639", (BALL, 4.3e-7, 1.7, 0.0, 4.75e-3, 3.6, 0.0)),
    "7": (
        "single row angular contact ball, other than 72 B, 73 B, 72 AC, 73 AC",
        (ANGULAR, 5.03e-7, 1.97, 1.9e-12, 1.3e-2, 0.68, 1.91e-12),
    ),
    "NU2": ("cylindrical roller with cage, 2, 3", (CYLINDRICAL, 1.09e-6, 0, 0, 0.16, 0.0015, 0)),
    "NU4": ("cylindrical roller with cage, 4", (CYLINDRICAL, 1e-6, 0, 0, 0.16, 0.0015, 0)),
    "NU10": ("cylindrical roller with cage, 10", (CYLINDRICAL, 1.12e-6, 0, 0, 0.17, 0.0015, 0)),
    "NU20": ("cylindrical roller with cage, 12, 20", (CYLINDRICAL, 1.23e-6, 0, 0, 0.16, 0.0015, 0)),
    "NU22": ("cylindrical roller with cage, 22", (CYLINDRICAL, 1.4e-6, 0, 0, 0.16, 0.0015, 0)),
    "NU23": ("cylindrical roller with cage, 23", (CYLINDRICAL, 1.48e-6, 0, 0, 0.16, 0.0015, 0)),
    "302": ("taper roller 302", (TAPER, 1.76e-6, 10.9, 0.0, 0.017, 2.0, 0.0)),
    "303": ("taper roller 303", (TAPER, 1.69e-6, 10.9, 0.0, 0.017, 2.0, 0.0)),
    "313": ("taper roller 313, 313 X", (TAPER, 1.84e-6, 10.9, 0.0, 0.048, 2.0, 0.0)),
    "320": ("taper roller 320 X", (TAPER, 2.38e-6, 10.9, 0.0, 0.014, 2.0, 0.0)),
    "322": ("taper roller 322", (TAPER, 2.27e-6, 10.9, 0.0, 0.018, 2.0, 0.0)),
    "322B": ("taper roller 322 B", (TAPER, 2.38e-6, 10.9, 0.0, 0.026, 2.0, 0.0)),
    "323": ("taper roller 323", (TAPER, 2.38e-6, 10.9, 0.0, 0.019, 2.0, 0.0)),
    "323B": ("taper roller 323 B", (TAPER, 2.79e-6, 10.9, 0.0, 0.03, 2.0, 0.0)),
    "329": ("taper roller 329", (TAPER, 2.31e-6, 10.9, 0.0, 0.009, 2.0, 0.0)),
    "330": ("taper roller 330", (TAPER, 2.71e-6, 11.3, 0.0, 0.01, 2.0, 0.0)),
    "331": ("taper roller 331", (TAPER, 2.71e-6, 10.9, 0.0, 0.015, 2.0, 0.0)),
    "332": ("taper roller 332", (TAPER, 2.71e-6, 10.9, 0.0, 0.018, 2.0, 0.0)),
}
ROW = 7  # numbers of a series
NUMBERS = tuple(float(x) for _, row in TABLE.values() for x in row)
NONE = {"none": "none of them: has no constants"}
# Options of a parameter: those of all types, and of the types whose friction needs no axial force.
SERIES = NONE | {name: words for name, (words, _) in TABLE.items()}
RADIAL = NONE | {n: words for n, (words, row) in TABLE.items() if row[0] in (BALL, CYLINDRICAL)}
RADIAL_NUMBERS = tuple(float(x) for n, (_, row) in TABLE.items() if n in RADIAL for x in row)
