"""Tables in files, read by their endings."""

from pathlib import Path

from ...errors import ParameterError, refuse_pipe
from .binary_file import read_binary
from .table import Table
from .text_file import read_text_table


def read_table(path: str | Path) -> Table:
    """Return the table of a file.

    Text (``.csv``, ``.txt``, ``.tsv`` or any other ending) in UTF-8, UTF-16 or Windows' western
    code page; comma, semicolon or tab between the cells; decimal points, or decimal commas where
    they cannot be anything else. ``.xlsx``, ``.mat`` and ``.mf4`` by packages that read them.

    Raises
    ------
    ParameterError : the file cannot be read, or can be read in two ways; the message says which
    """
    path = Path(path)
    if path.is_dir():
        raise ParameterError(f"{path}: is a folder, a file with a table is required")
    if path.exists():
        refuse_pipe(path)
    ending = path.suffix.lower()
    if ending in (".xlsx", ".xlsm", ".mat", ".mf4", ".mdf"):
        return read_binary(path)
    return read_text_table(path)
