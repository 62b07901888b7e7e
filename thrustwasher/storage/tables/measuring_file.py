"""Measuring files (MDF): groups of channels, each over times of its own, as one table."""

from collections.abc import Collection
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import ParameterError
from .column_names import Sum, added
from .table import LONGEST, Column, Table, plain_unit, several_text

INSTALL = 'pip install "thrustwasher[data]"'
MASTERS = ("virtual", "time", "angle", "distance", "index")  # kinds by their number in the format
TIME = 1
IS_MASTER = (2, 3)  # types of channels that the others of their group are over


@dataclass(frozen=True)
class Channel(Column):
    """A channel that is not read yet; ``group``: its name, or its number where others share it."""

    index: tuple[int, int] = (0, 0)  # of group and channel in the file
    master: tuple[int, str] = (0, "")  # group whose times it has, and what these are


@dataclass(frozen=True, eq=False)
class _Signal:
    """A channel as it was recorded."""

    channel: Channel
    time: NDArray[np.float64]  # (n,) of its group
    values: NDArray[np.float64]  # (n,), NaN where not valid
    unit: str

    def at(self, time: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return values at other times: straight between neighbours, NaN outside and next to NaN.

        An instant that was recorded has the value recorded there.
        """
        last = len(self.time) - 1
        left = np.clip(np.searchsorted(self.time, time, "right") - 1, 0, last)
        right = np.where(self.time[left] == time, left, np.minimum(left + 1, last))
        width = self.time[right] - self.time[left]
        share = (time - self.time[left]) / np.where(width > 0.0, width, 1.0)
        first = self.values[left]
        found = first + np.where(width > 0.0, share * (self.values[right] - first), 0.0)
        return np.where((time < self.time[0]) | (time > self.time[last]), np.nan, found)


class MeasuringTable(Table):
    """Channels of a measuring file; ``of_columns`` reads those that count."""

    def of_columns(self, names: Collection[str], may_lack: Collection[str] = ()) -> Table:
        """Return the channels that count at the times of the largest of their groups.

        Samples that the file marks invalid, or that are no number, do not count. Rows stay where
        all of ``names`` but ``may_lack`` are known: from their latest start to their earliest end.
        ``remarks`` say what is left out.
        """
        if sums := [c for c in self.columns if isinstance(c, Sum) and c.plain in names]:
            return self._with_sums(sums, names, may_lack)
        wanted = [c for c in self.columns if isinstance(c, Channel) and c.plain in names]
        for channel in wanted:
            same = [c for c in wanted if c.plain == channel.plain]
            if len(same) > 1:
                raise ParameterError(several_text(self.path, channel.plain, same))
        if not wanted:
            return self
        is_over = any(c.name == "time" and not isinstance(c, Channel) for c in self.columns)
        if ("time" in names and is_over) or len({c.master[0] for c in wanted}) > 1:
            for channel in wanted:
                _refuse_other_master(self.path, channel)
        signals, remarks = _read(self.path, wanted), list(self.remarks)
        longest = max(signals, key=lambda s: len(s.time))
        if len(longest.time) > LONGEST:
            raise ParameterError(f"{self.path}: has more than {LONGEST} rows")
        counts = np.ones(len(longest.time), bool)
        cells = {}
        for signal in signals:
            bad = int(np.count_nonzero(np.isnan(signal.values)))
            name, is_own = signal.channel.name, signal.channel.master == longest.channel.master
            if bad:
                remarks.append(f"{bad} of {len(signal.values)} samples of {name} left out: invalid")
            values = signal.values if is_own else self._resampled(signal, longest.time)
            if signal.channel.plain not in may_lack:
                late = (longest.time < signal.time[0]) | (longest.time > signal.time[-1])
                if not is_own and (counts & late).any():
                    remarks.append(
                        f"{np.count_nonzero(counts & late)} rows left out: {name} is recorded from "
                        f"{signal.time[0]:.6g} to {signal.time[-1]:.6g} s"
                    )
                counts &= np.isfinite(values)
            cells[signal.channel.index] = values
        rows = np.flatnonzero(counts)
        if not len(rows):
            spans = (f"{s.channel.name} {s.time[0]:.6g} .. {s.time[-1]:.6g} s" for s in signals)
            raise ParameterError(
                f"{self.path}: the channels have no valid samples at common times: "
                f"{', '.join(spans)}"
            )
        units = {s.channel.index: s.unit for s in signals}
        columns = [
            _filled(c, cells[c.index][rows], units[c.index])
            if isinstance(c, Channel) and c.index in cells
            else _filled(c, longest.time[rows], "s")
            if c.name == "time"
            else c
            for c in self.columns
        ]
        lines = (rows + 1).tolist()
        given, used = self.given, self.used
        return Table(self.path, columns, lines, remarks, binary=True, given=given, used=used)

    def _with_sums(
        self, sums: list[Sum], names: Collection[str], may_lack: Collection[str]
    ) -> Table:
        """Return the channels that count with sums of some, at common times."""
        columns = [c for c in self.columns if c not in sums]
        own = {}
        for total in sums:
            for k, (_, channel) in enumerate(total.terms):
                own[total.name, k] = replace(channel, name=f"{total.plain}#{k}")
        lacking = {c.plain for (name, _), c in own.items() if name.lower() in may_lack}
        table = replace(self, columns=[*columns, *own.values()]).of_columns(
            {*names, *(c.plain for c in own.values())}, {*may_lack, *lacking}
        )
        read = {c.plain: c for c in table.columns}
        made = []
        for total in sums:
            terms = [
                (sign, replace(read[own[total.name, k].plain], name=channel.name))
                for k, (sign, channel) in enumerate(total.terms)
            ]
            try:
                made.append(added(table, total.name, total.unit, terms))
            except ParameterError as error:
                raise ParameterError(f"{self.path}: --column {total.name}: {error}") from None
        kept = [c for c in table.columns if c.plain not in {x.plain for x in own.values()}]
        return replace(table, columns=[*kept, *made])

    def _resampled(self, signal: _Signal, time: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return a signal at times of another group."""
        if (np.diff(signal.time) < 0.0).any():
            raise ParameterError(
                f"{self.path}: time of the group {signal.channel.group!r} falls, rising times are "
                f"required to compare {signal.channel.name} with channels of other groups"
            )
        return signal.at(time)


def read_channels(path: Path) -> MeasuringTable:
    """Return the channels of an MDF file without their samples, next to a column ``time``.

    ParameterError: asammdf is missing, or the file cannot be read.
    """
    try:
        from asammdf import MDF
    except ImportError:
        raise ParameterError(f"{path}: asammdf is required to read it: {INSTALL}") from None
    try:
        with MDF(path) as file:
            found = _channels(file)
    except Exception as error:  # of asammdf, whatever a damaged file brings
        raise ParameterError(f"{path}: cannot be read as an MDF file ({error})") from None
    if not found:
        raise ParameterError(f"{path}: has no channels")
    own = [c for c in found if c.plain == "time"]
    remarks = [f"time of the groups; the channel {c.name} is called _{c.name}" for c in own[:1]]
    found = [replace(c, name=f"_{c.name}") if c in own else c for c in found]
    return MeasuringTable(str(path), [Column("time", "s", []), *found], [], remarks, binary=True)


def _channels(file: Any) -> list[Channel]:
    """Return all channels that others are not over."""
    found, names = [], []
    for own in file.virtual_groups:
        at = file.masters_db.get(own)
        kind = "rows without a master"
        if at is not None:
            master = file.groups[own].channels[at]
            kind = MASTERS[getattr(master, "sync_type", TIME)]
        for group, places in file.included_channels(own)[own].items():
            block = file.groups[group]
            names.append((group, str(getattr(block.channel_group, "acq_name", "") or "").strip()))
            for place in sorted(places):
                channel = block.channels[place]
                if channel.channel_type not in IS_MASTER:
                    index, over = (group, place), (own, kind)
                    found.append(Channel(channel.name, "", [], names[-1][1], index, over))
    named = [name for _, name in names]
    return [
        c if c.group and named.count(c.group) == 1 else replace(c, group=str(c.index[0]))
        for c in found
    ]


def _refuse_other_master(path: str, channel: Channel) -> None:
    """Raise ParameterError for a channel that is over no time."""
    if channel.master[1] != "time":
        raise ParameterError(
            f"{path}: channel {channel.name} of the group {channel.group!r} is recorded over "
            f"{channel.master[1]}, allowed: over time; resample it, or name another channel "
            f"(--column {channel.plain}=CHANNEL)"
        )


def _read(path: str, channels: list[Channel]) -> list[_Signal]:
    """Return channels with their samples."""
    from asammdf import MDF

    try:
        with MDF(path) as file:
            signals = file.select([(None, *c.index) for c in channels])
    except Exception as error:  # of asammdf, whatever a damaged file brings
        raise ParameterError(f"{path}: cannot be read as an MDF file ({error})") from None
    found = []
    for channel, signal in zip(channels, signals, strict=True):
        samples = np.asarray(signal.samples)
        where = f"{path}: channel {channel.name} of the group {channel.group!r}"
        if samples.dtype.kind not in "fiub" or samples.ndim != 1:
            raise ParameterError(f"{where} holds no numbers, one number a sample is required")
        if not len(samples):
            raise ParameterError(f"{where} has no samples")
        values = samples.astype(float)
        marked = signal.invalidation_bits
        if marked is not None:
            values[np.asarray(marked, bool)] = np.nan
        values[np.isinf(values)] = np.nan
        found.append(_Signal(channel, np.asarray(signal.timestamps, float), values, signal.unit))
    return found


def _filled(column: Column, values: NDArray[np.float64], unit: str) -> Column:
    """Return a column with its cells; a unit that was given for it counts before its own."""
    cells = ["" if x != x else repr(x) for x in values.tolist()]
    return replace(column, unit=column.unit or plain_unit(unit or ""), cells=cells)
