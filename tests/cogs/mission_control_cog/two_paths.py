"""The network of the simulator's two paths, for a test."""

from contextlib import contextmanager

from tests.support.tools import need_root, need_tool, unavailable
from up_simulator.harness.two_paths import PathsUnavailableError, TwoPaths


@contextmanager
def two_paths():
    """Make the network and yield it."""
    need_root()
    need_tool("ip", "iproute2")
    need_tool("nft", "nftables")
    paths = TwoPaths()
    try:
        paths.open()
    except PathsUnavailableError as error:
        unavailable(str(error))
    try:
        yield paths
    finally:
        paths.close()
