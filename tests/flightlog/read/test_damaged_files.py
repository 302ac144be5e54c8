"""Files that end anywhere, damaged files, and files of other programs."""

import io
import os
import struct
import tempfile
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mcap.writer import CompressionType
from mcap.writer import Writer as OfficialWriter

from tests.flightlog.logs import START_NS, LogMaker, official_messages, small_log
from up.flight_log.mcap_format import MAGIC, FlightLogError, Opcode
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.problems import Problems
from up_flightlog.read.record_scanner import (
    MAX_FILE,
    RecordScanner,
    read_file,
)

SMALL = small_log()
HEADER = struct.Struct("<BQ")


def scan(place: Path, data: bytes):
    """Return the data of the messages as the scanner finds them, and the codes of problems."""
    place.write_bytes(data)
    problems = Problems(place.name)
    found = []
    data = read_file(place)
    for opcode, start, length in RecordScanner(data, problems):
        if opcode == Opcode.MESSAGE and length >= 22:
            found.append(data[start + 22 : start + length])
    return found, [each.code for each in problems.all()]


def codes_of(place: Path, data: bytes):
    """Return the number of messages and the codes of the problems that a log reports."""
    place.write_bytes(data)
    log = FlightLog.read([place])
    count = sum(1 for _ in log.messages())
    return count, [each.code for each in log.problems]


def official_data(data: bytes) -> list[bytes]:
    return [message[-1] for message in official_messages(data)]


def record(opcode: int, content: bytes) -> bytes:
    return HEADER.pack(opcode, len(content)) + content


def message(channel: int = 1, data: bytes = b"{}") -> bytes:
    return record(5, struct.pack("<HIQQ", channel, 0, START_NS, START_NS) + data)


def head() -> bytes:
    maker = LogMaker()
    maker.channel("a")
    return bytes(maker.out)


def long_log(count: int) -> tuple[bytes, list[bytes]]:
    maker = LogMaker()
    written = [b'{"x": %d, "y": "%s"}' % (number, b"z" * 150) for number in range(count)]
    for number, data in enumerate(written):
        maker.raw(number / 100, "t", data)
    return maker.finished(), written


def official(compression, size=1024) -> bytes:
    out = io.BytesIO()
    writer = OfficialWriter(out, chunk_size=size, compression=compression)
    writer.start()
    schema = writer.register_schema("s", "jsonschema", b'{"type":"object"}')
    channel = writer.register_channel("a", "json", schema)
    for number in range(100):
        writer.add_message(channel, START_NS + number, b'{"x":%d}' % number, START_NS)
    writer.finish()
    return out.getvalue()


def test_a_file_cut_anywhere_gives_the_messages_before_the_cut(place):
    whole = official_data(SMALL)
    for size in range(len(MAGIC), len(SMALL)):
        found, codes = scan(place, SMALL[:size])
        assert found == official_data(SMALL[:size]) == whole[: len(found)], size
        assert codes == ["cut_off"], size


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (b'{"roll": 3.0', "data_checksum"),
        (b"rate: 2.0", "attachment_checksum"),
        (None, "summary_checksum"),
    ],
)
def test_a_flipped_bit_is_found_by_a_checksum(place, text, code):
    at = SMALL.rindex(b"up.altitude.change") if text is None else SMALL.index(text) + 9
    damaged = bytearray(SMALL)
    damaged[at] ^= 1
    count, codes = codes_of(place, bytes(damaged))
    assert (count, code in codes) == (9, True)


@pytest.mark.parametrize("length", [2**64 - 1, 2**63, 2**40, 17 * 1024 * 1024])
def test_an_absurd_length_ends_the_file(place, length):
    data = head() + message() + HEADER.pack(5, length) + b"x" * 50
    assert codes_of(place, data) == (1, ["bad_length"])


def test_a_very_long_record_is_skipped(place):
    data = head() + message() + record(0x80, bytes(17 * 1024 * 1024)) + message()
    count, codes = codes_of(place, data)
    assert (count, codes[0]) == (2, "record_skipped")


@pytest.mark.parametrize("fill", [b"\0", b"\xff", b"\5", b"\x05\1\0\0\0\0\0\0\0"])
@pytest.mark.parametrize("size", [1, 9, 500, 4096])
def test_a_bad_block_costs_only_its_records(place, fill, size):
    data, written = long_log(200)
    begin = data.index(b'{"x": 50,') + 70
    found, codes = scan(place, data[:begin] + (fill * size)[:size] + data[begin + size :])
    assert len(set(written) - set(found)) <= size / 150 + 2
    assert (found[:50], found[-50:]) == (written[:50], written[-50:])
    assert codes and "cut_off" not in codes


@pytest.mark.parametrize("byte", range(9))
def test_a_damaged_record_head_costs_its_record(place, byte):
    data, written = long_log(100)
    at = data.index(written[50]) - 31
    for value in (0, 1, 0x7F, 0xFF):
        damaged = bytearray(data)
        damaged[at + byte] = value
        found, codes = scan(place, bytes(damaged))
        assert set(written) - set(found) <= set(written[50:53])
        assert bytes(damaged) == data or codes


def test_records_after_much_damage_are_found(place):
    data, written = long_log(200)
    at = data.index(written[100]) - 31
    noise = b"\xfe\x05noise" * 500_000
    # Up to two records that look real are not enough to continue there.
    found, codes = scan(place, data[:at] + noise + message() * 2 + b"\xee" * 100 + data[at:])
    assert (found, codes) == (written, ["damaged_region"])


def test_zeros_after_a_power_cut_are_the_end(place):
    assert codes_of(place, head() + message() + bytes(4096)) == (1, ["no_records"])


def test_records_of_unknown_kinds_are_skipped(place):
    data = head() + record(0x80, b"private") + record(0x7F, b"") + message()
    assert codes_of(place, data)[0] == 1


@pytest.mark.parametrize(
    ("opcode", "content", "code"),
    [
        (3, b"\1", "malformed_record"),
        (3, b"\1\0" + b"\xff\xff\xff\xff", "malformed_record"),
        (4, b"\1\0\1\0" + b"\2\0\0\0\xff\xfe" + bytes(8), "malformed_record"),
        (5, b"\1\0", "short_message"),
        (9, bytes(16) + bytes(8) + b"\xff" * 8 + bytes(4), "malformed_record"),
        (12, b"\1\0\0\0a" + b"\xff\xff\xff\x7f", "malformed_record"),
    ],
)
def test_a_malformed_record_is_reported_and_skipped(place, opcode, content, code):
    count, codes = codes_of(place, head() + record(opcode, content) + message())
    assert (count, codes[0]) == (1, code)


@pytest.mark.parametrize(
    ("data", "code"),
    [(b"", "empty"), (b"\x89MCAP", "not_mcap"), (b"PK\3\4 something else", "not_mcap")],
)
def test_other_files_are_rejected(place, data, code):
    with pytest.raises(FlightLogError) as caught:
        scan(place, data)
    assert caught.value.code == code


def test_files_that_cannot_be_opened(tmp_path):
    huge = tmp_path / "huge.mcap"
    huge.touch()
    os.truncate(huge, MAX_FILE + 1)
    for path, code in (
        (huge, "too_large"),
        (tmp_path / "nothing.mcap", "unreadable"),
        (tmp_path, "not_a_file"),
        (tmp_path / "a\0b", "unreadable"),
    ):
        with pytest.raises(FlightLogError) as caught:
            read_file(path)
        assert caught.value.code == code


@pytest.mark.parametrize("size", [1, 100, 1024, 1024 * 1024])
def test_chunks_without_compression_are_read(place, size):
    data = official(CompressionType.NONE, size)
    found, codes = scan(place, data)
    assert (found, codes) == (official_data(data), [])
    assert len(found) == 100


def test_a_chunked_file_cut_anywhere_gives_its_messages_before_the_cut(place):
    data = official(CompressionType.NONE, 300)
    whole = official_data(data)
    for size in range(len(MAGIC), len(data), 7):
        found, codes = scan(place, data[:size])
        assert found == whole[: len(found)], size
        assert len(found) >= len(official_data(data[:size])), size
        assert "cut_off" in codes, size


def test_a_damaged_chunk_is_found_by_its_checksum(place):
    data = bytearray(official(CompressionType.NONE))
    data[data.index(b'{"x":5}') + 5] ^= 1
    found, codes = scan(place, bytes(data))
    assert (len(found), "chunk_checksum" in codes) == (100, True)


@pytest.mark.parametrize(
    ("inner", "code"),
    [
        (message() + HEADER.pack(5, 5000) + b"x", "chunk_lost"),
        (
            record(6, struct.pack("<QQQIIQ", 0, 0, 0, 0, 0, 0)) + record(2, bytes(20)) + message(),
            "nested_chunk",
        ),
    ],
)
def test_odd_records_in_a_chunk(place, inner, code):
    chunk = record(6, struct.pack("<QQQIIQ", 0, 0, len(inner), 0, 0, len(inner)) + inner)
    count, codes = codes_of(place, head() + chunk + message())
    assert (count, codes[0]) == (2, code)


def test_the_list_of_problems_is_bounded(place):
    many = b"".join(record(4, bytes(length)) for length in range(4) for _ in range(1000))
    many += b"".join(record(4, bytes(8) + b"\xff" * 4) for _ in range(10))
    assert len(codes_of(place, head() + many)[1]) < 10


@given(
    changes=st.lists(
        st.tuples(st.integers(len(MAGIC), len(SMALL) - 1), st.integers(0, 255)),
        min_size=1,
        max_size=8,
    ),
    cut=st.integers(len(MAGIC), len(SMALL)),
)
def test_any_change_is_reported_or_harmless(place, changes, cut):
    data = bytearray(SMALL)
    for at, byte in changes:
        data[at] = byte
    found, codes = scan(place, bytes(data[:cut]))
    # A channel's record may have become a message.
    assert len(found) <= 9 + len(changes)
    if data[:cut] != SMALL:
        assert codes or found == official_data(bytes(data[:cut])) or codes_of(place, data[:cut])[1]


@given(st.binary(max_size=300))
def test_any_bytes_after_the_magic_are_read(data):
    with tempfile.TemporaryDirectory() as folder:
        scan(Path(folder) / "flight.mcap", MAGIC + data)
