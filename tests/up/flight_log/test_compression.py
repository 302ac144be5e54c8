import contextlib

import pytest
import zstandard
from hypothesis import given
from hypothesis import strategies as st

from up.flight_log.compression import DecompressionError, compressor, decompressor

ZSTD_BOMB = zstandard.ZstdCompressor().compress(bytes(100_000_000))


@given(data=st.binary(max_size=2000))
def test_data_come_back_and_no_other_size_is_accepted(data):
    packed = compressor()(data)
    assert decompressor()(packed, len(data)) == data
    for size in {max(0, len(data) - 1), len(data) + 1} - {len(data)}:
        with pytest.raises(DecompressionError):
            decompressor()(packed, size)


@given(data=st.binary(max_size=200), size=st.integers(0, 1000))
def test_anything_else_is_an_error(data, size):
    with contextlib.suppress(DecompressionError):
        assert len(decompressor()(data, size)) == size


def test_a_bomb_is_not_expanded():
    assert len(ZSTD_BOMB) < 10_000
    with pytest.raises(DecompressionError):
        decompressor()(ZSTD_BOMB, 1000)
