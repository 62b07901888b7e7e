"""How slip of a pack and twist of the shaft answer to torques."""

from typing import NamedTuple


class Mobility(NamedTuple):
    """Accelerations per torque [1/(kg m2)] of slip and twist; ``cross``: of one by the other.

    ``drive``: of the slip by a torque at the driven gear; ``cross`` is that by one at the carrier.
    """

    slip: float
    cross: float
    twist: float
    drive: float = 0.0

    @property
    def determinant(self) -> float:
        """D of the module's text."""
        return self.slip * self.twist - self.cross**2


def planetary(
    ratio: float, sun: float, ring: float, carrier: float, vehicle: float, pack: str = "clutch"
) -> Mobility:
    """Return the mobility of a planetary set with the shaft at its carrier; inertias in kg m2.

    One pack slips, the other is open: the ``pack`` "clutch" between sun and ring or "brake" at the
    ring. ``ratio`` is z_ring/z_sun; ``ring`` may be 0.
    """
    r = ratio
    share = ring / r**2
    m_ss, m_sc, m_cc = sun + share, -share * (1.0 + r), carrier + share * (1.0 + r) ** 2
    det = m_ss * m_cc - m_sc**2
    i_ss, i_sc, i_cc = m_cc / det, -m_sc / det, m_ss / det
    # slip = a sun + b carrier
    a, b = ((1.0 + r) / r, -(1.0 + r) / r) if pack == "clutch" else (-1.0 / r, (1.0 + r) / r)
    return Mobility(
        a * a * i_ss + 2.0 * a * b * i_sc + b * b * i_cc,
        a * i_sc + b * i_cc,
        i_cc + 1.0 / vehicle,
        a * i_ss + b * i_sc,
    )
