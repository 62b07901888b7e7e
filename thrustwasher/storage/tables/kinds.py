"""Kinds of files: those that are read by other packages, and those that are not read at all."""

from pathlib import Path

from ...errors import ParameterError

SPREADSHEETS, MATLAB = (".xlsx", ".xlsm"), (".mat",)
MEASURING, PARQUET = (".mf4", ".mdf"), (".parquet",)
FORMATS = "text (.csv, .txt, .tsv, .lvm, ..), .xlsx, .xlsm, .mat, .mf4, .mdf, .parquet"
# Ending -> what it is, and how its numbers come into a file that is read.
REFUSED = {
    ".ods": ("an OpenDocument spreadsheet", "save it as .xlsx or .csv"),
    ".xls": ("a workbook of an old kind", "save it as .xlsx or .csv"),
    ".tdms": ("a TDMS file of LabVIEW or DIAdem", "export it as .csv"),
    ".blf": ("a log of bus messages", "export its signals as .mf4"),
    ".asc": ("a log of bus messages", "export its signals as .mf4 or .csv"),
    ".uff": ("a Universal File", "export it as .csv or .mat"),
    ".unv": ("a Universal File", "export it as .csv or .mat"),
    ".h5": ("an HDF5 file", "export it as .csv, .mat or .parquet"),
    ".hdf5": ("an HDF5 file", "export it as .csv, .mat or .parquet"),
    ".nc": ("a netCDF file", "export it as .csv or .parquet"),
}
# First bytes -> the ending that the file should have.
BEGINS = {
    b"TDSm": ".tdms",
    b"LOGG": ".blf",
    b"PAR1": ".parquet",
    b"MDF     ": ".mdf",
    b"\x89HDF\r\n": ".h5",
    b"\xd0\xcf\x11\xe0": ".xls",
}
TABLE_INSIDE = (".asc",)  # by other programs these are tables in text


def kind_of(path: Path) -> str:
    """Return the ending by which a file is read: its own, or what its first bytes say."""
    ending = path.suffix.lower()
    known = (*SPREADSHEETS, *MATLAB, *MEASURING, *PARQUET, *REFUSED)
    if ending in known or not path.is_file():
        return ending
    with path.open("rb") as file:
        begin = file.read(80)
    if begin[:2] == b"PK" and b"opendocument.spreadsheet" in begin:
        return ".ods"
    return next((kind for mark, kind in BEGINS.items() if begin.startswith(mark)), ending)


def refusal(path: Path, kind: str) -> ParameterError:
    """Return the error for a file of a kind that is not read."""
    what, cure = REFUSED[kind]
    return ParameterError(f"{path}: is {what} ({kind}), which is not read; {cure}; read: {FORMATS}")
