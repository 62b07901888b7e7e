"""Who could change a folder: its owner, and the owners of all that leads to it.

Who may rename a folder can put another one in its place, so that a folder of mode 0700 is the
user's alone only if every folder above it is the user's or the system's.
"""

import errno
import os
import stat
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

MOST_LINKS = 40  # on the way to a folder, as the kernel counts them


def ways_to(folder: str | os.PathLike[str]) -> Iterator[Path]:
    """Yield all that leads to a folder and the folder, from the root on; of links both ends."""
    whole = Path(folder) if Path(folder).is_absolute() else Path(os.getcwd(), folder)
    rest, at, links = [*reversed(whole.parts)], Path(), 0
    while rest:
        step = rest.pop()
        if step == "..":  # in a link: what stands before it is no link
            at = at.parent
            continue
        at = at / step
        yield at
        if at.is_symlink():
            links += 1
            if links > MOST_LINKS:
                raise OSError(errno.ELOOP, os.strerror(errno.ELOOP), str(folder))
            rest += reversed(Path(os.readlink(at)).parts)
            at = at.parent


def doubt_of(folder: str | os.PathLike[str]) -> str:
    """Return who else could change what lies in a folder, "" if nobody could.

    Everything that leads there has to be the user's or the system's, and written by nobody else,
    but for folders where names are safe from others (sticky, as the temporary folder). OSError: it
    is not there. On Windows the folders of a user's profile are closed to others by the system.
    """
    if sys.platform == "win32":
        return ""
    for place in ways_to(folder):
        about = place.lstat()
        if about.st_uid not in (os.getuid(), 0):
            return f"{place} belongs to another user"
        if not stat.S_ISLNK(about.st_mode) and is_written_by_others(about):
            return f"{place} could be written by others"
    return ""


def is_written_by_others(about: os.stat_result) -> bool:
    """Tell if somebody else may put a name of his into a folder or take one away."""
    if about.st_mode & stat.S_ISVTX:
        return False
    loose = about.st_mode & (stat.S_IWGRP | stat.S_IWOTH)
    return bool(loose) and not (loose == stat.S_IWGRP and _is_own_group(about.st_gid))


@cache
def _is_own_group(number: int) -> bool:
    """Tell if a group is the user's alone: his first one, of his name, with no other members."""
    import grp
    import pwd

    try:
        user, group = pwd.getpwuid(os.getuid()), grp.getgrgid(number)
    except KeyError:
        return False
    named = user.pw_gid == number and group.gr_name == user.pw_name
    return named and set(group.gr_mem) <= {user.pw_name}
