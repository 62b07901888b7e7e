"""Tables in files, read by their endings."""

from pathlib import Path

from ...errors import ParameterError, refuse_pipe
from .heads import USUAL, Wanted
from .kinds import MATLAB, MEASURING, PARQUET, REFUSED, SPREADSHEETS, TABLE_INSIDE, kind_of, refusal
from .matlab_file import read_matlab
from .measuring_file import read_channels
from .parquet_file import read_parquet
from .spreadsheet import read_spreadsheet
from .table import Table
from .text_file import read_text_table


def read_table(path: str | Path, wanted: Wanted = USUAL) -> Table:
    """Return the table of a file.

    Text (``.csv``, ``.txt``, ``.tsv`` or any other ending) in UTF-8, UTF-16 or Windows' western
    code page; comma, semicolon or tab between the cells; decimal points, or decimal commas where
    they cannot be anything else. ``.xlsx``, ``.mat``, ``.mf4`` and ``.parquet`` by packages that
    read them.

    Parameters
    ----------
    path : of the file
    wanted : where the table stands in it, if that is not told by the file

    Raises
    ------
    ParameterError : the file cannot be read, or can be read in two ways; the message says which
    """
    path = Path(path)
    if path.is_dir():
        raise ParameterError(f"{path}: is a folder, a file with a table is required")
    if path.exists():
        refuse_pipe(path)
    kind = kind_of(path)
    if kind in REFUSED and path.is_file():
        if kind not in TABLE_INSIDE:
            raise refusal(path, kind)
        try:
            return read_text_table(path, wanted)
        except ParameterError:
            raise refusal(path, kind) from None
    by_others = (*SPREADSHEETS, *MATLAB, *MEASURING, *PARQUET)
    if kind in by_others and not path.is_file():
        raise ParameterError(f"{path}: there is no such file")
    if wanted.sheet and kind not in (*SPREADSHEETS, *MATLAB):
        raise ParameterError(f"{path}: --sheet {wanted.sheet}: allowed: with .xlsx and .mat")
    if (wanted.table or wanted.skip is not None) and kind in by_others[2:]:
        raise ParameterError(f"{path}: --skip, --table: allowed: with text and .xlsx")
    if kind in SPREADSHEETS:
        return read_spreadsheet(path, wanted)
    if kind in MATLAB:
        return read_matlab(path, wanted)
    if kind in PARQUET:
        return read_parquet(path)
    return read_channels(path) if kind in MEASURING else read_text_table(path, wanted)
