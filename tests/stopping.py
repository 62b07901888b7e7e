"""Runs that are stopped in the middle, from their own report of progress."""


class Stop(Exception):
    pass


def stopping_after(n):
    """Return what is told of progress and stops a run that has done ``n`` of its rows."""

    def progress(done, total):
        if done >= n:
            raise Stop

    return progress
