"""Tables that benchmarks print: Markdown, each row as soon as it is measured."""


def table_head(*names: str) -> None:
    """Print the names of the columns and the rule below them."""
    table_row(*names)
    print("|---" * len(names) + "|")


def table_row(*cells: object) -> None:
    """Print one row."""
    print(f"| {' | '.join(map(str, cells))} |", flush=True)


def median_and_least(seconds: tuple[float, float], unit: float, form: str) -> str:
    """Return median and minimum in a unit [1/s], such as 1e6 for microseconds."""
    return " ".join((f"{unit * seconds[0]:{form}}", f"({unit * seconds[1]:{form}})"))
