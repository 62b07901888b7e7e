"""Every loop of the kernels that ends by a test: where it is, its bound, what comes out there."""


def bound_of(model: str, fidelity: str) -> str:
    return "?"
