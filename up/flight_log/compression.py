"""zstd, which compresses the chunks of a flight log; the package zstandard is optional."""

from collections.abc import Callable
from typing import Any

zstandard: Any
try:
    import zstandard
except ImportError:
    zstandard = None

ZSTD = "zstd"
"""The name of the method in a chunk (https://mcap.dev/spec/registry)."""
LEVEL = 3
"""The package's default: chunks of telemetry shrink to a fifth in 25 us."""
_MAX_WINDOW = 128 * 1024 * 1024
Compress = Callable[[bytes], bytes]


class DecompressionError(ValueError):
    """Data cannot be decompressed to the size that they claim."""


def compressor() -> Compress | None:
    """Return a function that compresses, for one thread; None where zstandard is missing."""
    if zstandard is None:
        return None
    compress: Compress = zstandard.ZstdCompressor(level=LEVEL).compress
    return compress


def decompressor() -> Callable[[bytes, int], bytes] | None:
    """Return a function of data and their size, bytes; None where zstandard is missing.

    It takes no more memory than that size and the window of zstd, and raises DecompressionError.
    """
    if zstandard is None:
        return None
    zstd = zstandard.ZstdDecompressor(max_window_size=_MAX_WINDOW)

    def decompress(data: bytes, size: int) -> bytes:
        try:
            with zstd.stream_reader(data, read_across_frames=True) as reader:
                found: bytes = reader.read(size + 1)
        except zstandard.ZstdError as error:
            raise DecompressionError(str(error)) from None
        if len(found) != size:
            raise DecompressionError(f"{len(found)} bytes instead of {size}")
        return found

    return decompress
