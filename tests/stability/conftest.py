"""The FMUs' own files in ``loops/slaves`` are all called slave.py, and are no tests."""

collect_ignore_glob = ["loops/slaves/*"]
