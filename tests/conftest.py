"""Where tests keep what is built for them, and which warnings are theirs."""

import gc
import os
import shutil
from pathlib import Path

import pytest
from hypothesis import settings

TESTS = Path(__file__).parent
CACHE = TESTS.parent / ".cache"

# The checkout's own cache: its subfolders are keyed by the sources.
os.environ.setdefault("NUMBA_CACHE_DIR", str(CACHE))
os.environ.setdefault("XDG_CACHE_HOME", str(CACHE))
# also where a test looks at an empty cache: ziglang compiles parts of its C library into its own
os.environ.setdefault("ZIG_GLOBAL_CACHE_DIR", os.path.join(os.environ["XDG_CACHE_HOME"], "zig"))
os.environ.setdefault("MPLBACKEND", "Agg")
for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):  # the processes share the cores
    os.environ.setdefault(threads, "1")
os.environ["SOURCE_DATE_EPOCH"] = "1767225600"  # builds repeat while somebody commits

import needed  # noqa: E402  (it imports the package, which looks at the above)

from thrustwasher.errors import EnvironmentProblem  # noqa: E402

# the same examples in every run; lab/benchmarks/abuse.py tries others
settings.register_profile("fixed", derandomize=True, deadline=None)  # no timed tests
settings.load_profile("fixed")

PASSED = pytest.StashKey[bool]()

# pytest looks for doctests in conftest.py too, and knows one module of that name at a time
collect_ignore_glob = ["*conftest.py"]


def pytest_configure(config):
    """Make warnings errors that tests, their helpers or the examples cause."""
    paths = [*TESTS.rglob("*.py"), *(TESTS.parent / "examples").glob("*.py")]
    names = {path.stem for path in paths} | {path.parent.name for path in paths}
    config.addinivalue_line("filterwarnings", rf"error:::({'|'.join(sorted(names))})(\.|$)")


@pytest.hookimpl(wrapper=True)
def pytest_collection():
    """Look for no garbage among the tests that are found: it takes a sixth of the time."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()


@pytest.fixture(scope="module")
def browser():
    """Give a headless browser."""
    from browser_pages import chromium

    with chromium() as found:
        yield found


@pytest.fixture
def tmp_path(tmp_path, request):
    """Empty the folder of a test that passed: those of all tests together fill a small disk.

    The folder itself stays, so that no later test has one of the same name.
    """
    yield tmp_path
    if request.node.stash.get(PASSED, False):
        shutil.rmtree(tmp_path, ignore_errors=True)
        tmp_path.mkdir(exist_ok=True)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item):
    """Skip a test that came upon something that the machine lacks; in CI it fails."""
    try:
        found = yield
        item.stash[PASSED] = True
        return found
    except EnvironmentProblem as problem:
        if needed.IN_CI or not any(words in str(problem) for words in needed.LACKS):
            raise
        pytest.skip(str(problem))


AGAIN = "thrustwasher/__init__.py::thrustwasher."


def pytest_collection_modifyitems(items):
    """Begin with what takes minutes in one test, so that the processes end at about the same time.

    Examples of public functions are run where these are defined, not once more as public names.
    """
    long = {"test_compiled_here", "test_gearmesh"}
    items[:] = [item for item in items if not item.nodeid.startswith(AGAIN)]
    items.sort(key=lambda item: item.path.stem not in long)
