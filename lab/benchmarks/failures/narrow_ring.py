"""An exact solution: the load of a tilted narrow ring."""


def narrow_ring_load(
    viscosity: float,
    speed: float,
    inner_radius: float,
    outer_radius: float,
    least_gap: float,
    largest_gap: float,
) -> float:
    """Return the load [N] of a tilted narrow ring with Reynolds cavitation.

    The pressure is a parabola across the width L where the film closes and zero where it opens;
    W = mu omega R L^3/4 (1/h_min^2 - 1/h_max^2) with the mean radius R and the gaps there. Smooth
    surfaces, constant viscosity; error of relative order (L/R)^2.
    """
    mean = 0.5 * (inner_radius + outer_radius)
    width = outer_radius - inner_radius
    return 0.25 * viscosity * speed * mean * width**3 * (1.0 / least_gap**2 - 1.0 / largest_gap**2)
