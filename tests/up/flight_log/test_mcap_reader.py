import io
import struct
import zlib
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mcap.stream_reader import CRCValidationError, StreamReader
from mcap.writer import CompressionType
from mcap.writer import Writer as OfficialWriter

from tests.up.flight_log.logs import START_NS, LogMaker, official_messages, small_log
from up.flight_log import record_walk
from up.flight_log.mcap_format import MAGIC, FlightLogError
from up.flight_log.mcap_reader import read_records
from up.flight_log.mcap_records import AttachedFile, Channel, Header, Message, Metadata, Schema

SMALL = small_log()
HEADER = struct.Struct("<BQ")


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    return tmp_path_factory.mktemp("logs") / "flight.mcap"


def read(place: Path, data: bytes):
    place.write_bytes(data)
    problems: list[str] = []
    return list(read_records(place, problems)), problems


def messages_of(records):
    return [
        (m.channel_id, m.sequence, m.log_time_ns, m.publish_time_ns, m.data)
        for m in records
        if isinstance(m, Message)
    ]


def record(opcode: int, content: bytes) -> bytes:
    return HEADER.pack(opcode, len(content)) + content


def message(channel: int, data: bytes = b"{}") -> bytes:
    return record(5, struct.pack("<HIQQ", channel, 0, START_NS, START_NS) + data)


def head() -> bytes:
    out = bytearray()
    maker = LogMaker()
    maker.channel("a")
    out += maker.out
    return bytes(out)


def test_a_whole_file_gives_its_records_in_order(place):
    records, problems = read(place, SMALL)
    assert problems == []
    kinds = [type(each) for each in records]
    assert kinds[:5] == [Header, Metadata, AttachedFile, Schema, Channel]
    assert kinds.count(Message) == 9
    assert messages_of(records) == official_messages(SMALL)
    assert records[1].values == {"aircraft": "glider-1", "host": "pi"}
    attached = records[2]
    assert SMALL[attached.offset : attached.offset + attached.size] == b"rate: 2.0\n"
    assert attached.is_intact


def test_a_file_cut_anywhere_gives_what_came_before(place):
    whole = official_messages(SMALL)
    counts = set()
    for size in range(len(SMALL)):
        part = SMALL[:size]
        if size < len(MAGIC):
            with pytest.raises(FlightLogError):
                read(place, part)
            continue
        records, problems = read(place, part)
        messages = messages_of(records)
        assert messages == official_messages(part), size
        assert messages == whole[: len(messages)], size
        assert len(problems) == 1, size
        assert "cut off" in problems[0], size
        counts.add(len(messages))
    assert counts == set(range(10))


def test_the_window_may_end_anywhere(place, monkeypatch):
    # Blocks of all sizes put the ends of the window into every field of every record.
    for data in (SMALL, official(CompressionType.NONE, 300)):
        expected = read(place, data)
        assert expected[1] == []
        for window in range(1, 80):
            with monkeypatch.context() as patch:
                patch.setattr(record_walk, "_WINDOW", window)
                assert read(place, data) == expected


def test_a_flipped_bit_is_told_by_the_checksum(place):
    at = SMALL.index(b'{"roll": 3.0')
    damaged = bytearray(SMALL)
    damaged[at + 9] ^= 1
    with pytest.raises(CRCValidationError):
        list(StreamReader(io.BytesIO(damaged), validate_crcs=True).records)
    records, problems = read(place, bytes(damaged))
    assert len(messages_of(records)) == 9
    assert len(problems) == 1
    assert "does not match its checksum: something is damaged" in problems[0]


def test_a_damaged_summary_and_a_damaged_attachment_are_told(place):
    damaged = bytearray(SMALL)
    damaged[SMALL.rindex(b"up.altitude.change")] ^= 1
    assert "its summary does not match" in read(place, bytes(damaged))[1][0]
    damaged = bytearray(SMALL)
    damaged[SMALL.index(b"rate: 2.0")] ^= 1
    records, problems = read(place, bytes(damaged))
    assert not records[2].is_intact
    assert any("an attachment does not match its checksum" in each for each in problems)


@pytest.mark.parametrize("length", [2**64 - 1, 2**63, 2**40, 17 * 1024 * 1024])
def test_an_absurd_length_ends_the_file_in_a_sentence(place, length):
    data = head() + message(1) + HEADER.pack(5, length) + b"x" * 50
    records, problems = read(place, data)
    assert len(messages_of(records)) == 1
    assert len(problems) == 1
    assert f"{length} bytes" in problems[0]
    assert "59 bytes are lost" in problems[0]


def test_a_record_that_is_too_long_for_the_window_is_passed_over(place):
    data = head() + message(1) + record(0x80, bytes(17 * 1024 * 1024)) + message(1)
    records, problems = read(place, data)
    assert len(messages_of(records)) == 2
    assert "is passed over" in problems[0]


def long_log(count: int, size: int = 150) -> tuple[bytes, list[bytes]]:
    maker = LogMaker()
    told = []
    for number in range(count):
        told.append(b'{"x": %d, "y": "%s"}' % (number, b"z" * size))
        maker.raw(number / 100, "t", told[-1])
    return maker.finished(), told


@pytest.mark.parametrize("fill", [b"\0", b"\xff", b"\5", b"\x05\1\0\0\0\0\0\0\0"])
@pytest.mark.parametrize("size", [1, 9, 500, 4096])
def test_a_bad_block_in_the_middle_costs_only_itself(place, fill, size):
    data, told = long_log(200)
    begin = data.index(b'{"x": 50,') + 70
    damaged = data[:begin] + (fill * size)[:size] + data[begin + size :]
    records, problems = read(place, damaged)
    found = [each.data for each in records if isinstance(each, Message)]
    lost = set(told) - set(found)
    assert len(lost) <= size / 150 + 2
    assert found[:50] == told[:50]
    assert found[-50:] == told[-50:]
    assert problems
    assert not any("cut off" in each for each in problems)


@pytest.mark.parametrize("byte", range(9))
def test_a_broken_head_costs_its_record(place, byte):
    data, told = long_log(100)
    at = data.index(told[50]) - 31
    for value in (0, 1, 0x7F, 0xFF):
        damaged = bytearray(data)
        damaged[at + byte] = value
        records, problems = read(place, bytes(damaged))
        found = [each.data for each in records if isinstance(each, Message)]
        assert set(told) - set(found) <= set(told[50:53])
        assert bytes(damaged) == data or problems


def test_what_goes_on_behind_more_damage_than_the_window_is_found(place):
    data, told = long_log(200)
    at = data.index(told[100]) - 31
    noise = b"\xfe\x05noise" * 500_000
    records, problems = read(place, data[:at] + noise + data[at:])
    assert [each.data for each in records if isinstance(each, Message)] == told
    assert problems == [f"flight.mcap: a damaged place is passed over (at byte {at})"]


def test_zeros_after_a_power_cut_are_the_end(place):
    records, problems = read(place, head() + message(1) + bytes(4096))
    assert len(messages_of(records)) == 1
    assert problems == [
        f"flight.mcap: no records any more, 4096 bytes are lost: cut off or damaged"
        f" (at byte {len(head() + message(1))})"
    ]


def test_records_of_unknown_kinds_are_skipped(place):
    data = head() + record(0x80, b"private") + record(0x7F, b"") + message(1)
    assert len(messages_of(read(place, data)[0])) == 1


@pytest.mark.parametrize(
    ("opcode", "content"),
    [
        (3, b"\1"),
        (3, b"\1\0" + b"\xff\xff\xff\xff"),
        (4, b"\1\0\1\0" + b"\2\0\0\0\xff\xfe" + bytes(8)),
        (5, b"\1\0"),
        (9, bytes(16) + bytes(8) + b"\xff" * 8 + bytes(4)),
        (12, b"\1\0\0\0a" + b"\xff\xff\xff\x7f"),
    ],
)
def test_a_malformed_record_is_counted_and_left_out(place, opcode, content):
    data = head() + record(opcode, content) + message(1)
    records, problems = read(place, data)
    assert len(messages_of(records)) == 1
    assert "a malformed record is left out" in problems[0]


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"", "it is empty"),
        (b"\x89MCAP", "does not begin as MCAP"),
        (b"PK\3\4 something else", "does not begin as MCAP"),
    ],
)
def test_what_is_no_log_is_refused_in_a_sentence(place, data, why):
    with pytest.raises(FlightLogError, match=why):
        read(place, data)


def test_what_cannot_be_opened_is_refused_in_a_sentence(tmp_path):
    with pytest.raises(FlightLogError, match=r"nothing\.mcap: cannot be opened: No such file"):
        list(read_records(tmp_path / "nothing.mcap"))
    with pytest.raises(FlightLogError, match="it is no file"):
        list(read_records(tmp_path))
    with pytest.raises(FlightLogError, match="cannot be opened"):
        list(read_records(tmp_path / "a\0b"))


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


@pytest.mark.parametrize("size", [1, 100, 1024, 1024 * 1024])
def test_chunks_without_compression_are_read(place, size):
    data = official(CompressionType.NONE, size)
    records, problems = read(place, data)
    assert problems == []
    assert messages_of(records) == official_messages(data)
    assert len(messages_of(records)) == 100


def test_a_chunked_file_cut_anywhere_gives_its_whole_chunks_and_of_the_last_what_it_has(place):
    data = official(CompressionType.NONE, 300)
    whole = official_messages(data)
    for size in range(len(MAGIC), len(data), 7):
        found, problems = read(place, data[:size])
        told, least = messages_of(found), official_messages(data[:size])
        assert told == whole[: len(told)], size
        assert len(told) >= len(least), size
        assert any("cut off" in each for each in problems), size


def test_a_damaged_chunk_is_told_by_its_checksum(place):
    data = bytearray(official(CompressionType.NONE))
    data[data.index(b'{"x":5}') + 5] ^= 1
    records, problems = read(place, bytes(data))
    assert len(messages_of(records)) == 100
    assert any("a chunk does not match its checksum" in each for each in problems)


def test_a_record_that_overruns_its_chunk_costs_the_rest_of_it(place):
    inner = message(1) + HEADER.pack(5, 5000) + b"x"
    chunk = record(6, struct.pack("<QQQIIQ", 0, 0, len(inner), 0, 0, len(inner)) + inner)
    records, problems = read(place, head() + chunk + message(1))
    assert len(messages_of(records)) == 2
    assert "a chunk is damaged" in problems[0]


def test_a_chunk_in_a_chunk_and_a_footer_in_a_chunk_change_nothing(place):
    inner = record(6, struct.pack("<QQQIIQ", 0, 0, 0, 0, 0, 0)) + record(2, bytes(20)) + message(1)
    chunk = record(6, struct.pack("<QQQIIQ", 0, 0, len(inner), 0, 0, len(inner)) + inner)
    records, problems = read(place, head() + chunk + message(1))
    assert len(messages_of(records)) == 2
    assert "a chunk inside a chunk" in problems[0]


@pytest.mark.parametrize("compression", [CompressionType.LZ4, CompressionType.ZSTD])
def test_compression_is_told_in_a_sentence(place, compression):
    records, problems = read(place, official(compression))
    assert messages_of(records) == []
    assert len(problems) == 1
    assert f"compressed ('{compression.name.lower()}') is not read" in problems[0]


def test_problems_without_end_stay_few(place):
    many = b"".join(record(4, bytes(length)) for length in range(4) for _ in range(1000))
    problems = read(place, head() + many)[1]
    assert len(problems) < 10
    assert "1000 times" in problems[0] or "4000 times" in problems[0]


@settings(
    max_examples=300, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    changes=st.lists(
        st.tuples(st.integers(0, len(SMALL) - 1), st.integers(0, 255)), min_size=1, max_size=8
    ),
    cut=st.integers(len(MAGIC), len(SMALL)),
)
def test_no_mutation_raises_anything_else(place, changes, cut):
    data = bytearray(SMALL)
    for at, byte in changes:
        data[at] = byte
    try:
        records, problems = read(place, bytes(data[:cut]))
    except FlightLogError:
        assert data[: len(MAGIC)] != MAGIC
        return
    # A channel's record may have become a message.
    assert len(messages_of(records)) <= 9 + len(changes)
    if bytes(data[:cut]) != SMALL and zlib.crc32(data[:cut]) != zlib.crc32(SMALL):
        assert problems or messages_of(records) == official_messages(bytes(data[:cut]))


@given(st.binary(max_size=300))
def test_any_bytes_after_the_magic_are_read_without_a_fault(data):
    # hypothesis and fixtures do not mix well here, hence a separate folder.
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        read(Path(folder) / "flight.mcap", MAGIC + data)
