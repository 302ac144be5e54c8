"""Chunks compressed by zstd: whole, damaged, hostile, and more than fit."""

import struct

import pytest
from mcap.writer import CompressionType

from tests.flightlog.logs import START_NS
from tests.flightlog.read.test_damaged_files import (
    SMALL,
    codes_of,
    head,
    message,
    official,
    record,
)
from tests.up.flight_log.test_compression import ZSTD_BOMB
from up.flight_log import compression
from up.flight_log.compression import compressor
from up.flight_log.mcap_format import MAGIC, FlightLogError
from up.flight_log.mcap_writer import McapWriter
from up_flightlog.read import expanded_records, record_scanner
from up_flightlog.read.flight_log import FlightLog
from up_flightlog.read.log_index import LogIndex
from up_flightlog.read.record_scanner import MAX_CHUNK, MAX_RATIO


def compressed() -> bytes:
    out = bytearray()
    writer = McapWriter(out.extend, compress=compressor())
    writer.start()
    channel = writer.add_channel("a", writer.add_schema("s", {}))
    for number in range(100):
        writer.message(channel, START_NS + number, b'{"x":%d}' % number)
        if number % 10 == 9:
            writer.end_chunk()
    writer.finish()
    return bytes(out)


def numbers_of(place, data) -> tuple[list[int], list[str]]:
    place.write_bytes(data)
    log = FlightLog.read([place])
    return [each.data["x"] for each in log.messages("a")], [each.code for each in log.problems]


@pytest.mark.parametrize("size", [1, 300, 1024 * 1024])
def test_chunks_compressed_by_zstd_are_read(place, size):
    assert numbers_of(place, official(CompressionType.ZSTD, size)) == ([*range(100)], [])


def test_chunks_compressed_otherwise_are_skipped(place):
    assert codes_of(place, official(CompressionType.LZ4)) == (0, ["chunk_skipped"])


def test_a_compressed_file_cut_anywhere_gives_the_whole_chunks_before_the_cut(place):
    data, most = official(CompressionType.ZSTD, 300), 0
    for size in range(len(MAGIC), len(data), 7):
        found, codes = numbers_of(place, data[:size])
        assert found == [*range(len(found))], size
        assert len(found) >= most, size
        assert "cut_off" in codes, size
        most = len(found)
    assert most == 100


def test_a_damaged_byte_costs_at_most_its_chunk_and_the_next(place):
    data = compressed()
    for at in range(data.index(b"zstd"), data.rindex(b"zstd"), 5):
        damaged = bytearray(data)
        damaged[at] ^= 0xFF
        found, codes = numbers_of(place, bytes(damaged))
        lost = sorted({*range(100)} - {*found})
        assert len(lost) <= 22, at
        assert lost == [*range(lost[0], lost[-1] + 1)] if lost else True, at
        assert codes, at


def test_a_damaged_head_costs_two_chunks_at_most_in_a_file_that_has_its_end(place):
    data = compressed()
    for at in range(len(MAGIC) + 9, data.index(b"zstd") - 60):
        damaged = bytearray(data)
        damaged[at] ^= 0x40
        found, _ = numbers_of(place, bytes(damaged))
        assert found == [*range(100 - len(found), 100)] and len(found) >= 80, at


def test_a_damaged_record_of_the_head_costs_only_itself(place):
    data = compressed()
    cut = data[: data.rindex(b"zstd") + 100]
    schema = data.index(b"\x03")
    damaged = bytearray(cut)
    damaged[schema + 4] = 0x40
    found, codes = numbers_of(place, bytes(damaged))
    assert found == [*range(len(found))] and len(found) >= 90
    assert "damaged_region" in codes


def test_several_frames_in_a_chunk_are_read(place):
    records = [message(data=b'{"x":%d}' % number) for number in range(2)]
    packed = b"".join(map(compressor(), records))
    content = struct.pack("<QQQII", 0, 0, sum(map(len, records)), 0, 4) + b"zstd"
    data = head() + record(6, content + struct.pack("<Q", len(packed)) + packed)
    assert numbers_of(place, data)[0] == [0, 1]


def test_chunks_expand_to_a_multiple_of_their_file_at_most(place, monkeypatch):
    monkeypatch.setattr(record_scanner, "ALWAYS_EXPANDED", 1000)
    records = message(data=b'"%s"' % bytes(400_000)) + message()
    packed = compressor()(records)
    content = struct.pack("<QQQII", 0, 0, len(records), 0, 4) + b"zstd"
    chunk = record(6, content + struct.pack("<Q", len(packed)) + packed)
    assert len(records) > MAX_RATIO * len(chunk)
    plain = message() * 4
    count, codes = codes_of(place, head() + plain + chunk * 3 + plain)
    assert (count, codes) == (8, ["expansion_limit", "cut_off"])


def test_many_records_are_expanded_on_the_disk(place, tmp_path, monkeypatch):
    data = compressed()
    monkeypatch.setattr(expanded_records, "MAX_IN_MEMORY", 1000)
    monkeypatch.setattr(expanded_records, "RESERVE", 0)
    assert numbers_of(place, data) == ([*range(100)], [])
    second = tmp_path / "second.mcap"
    second.write_bytes(official(CompressionType.NONE))
    # As much free space is nowhere.
    monkeypatch.setattr(expanded_records, "RESERVE", 1 << 62)
    log = FlightLog.read([place, second])
    assert [each.code for each in log.problems] == ["no_room"]
    assert len([each for each in log.messages() if each.data["x"] >= 0]) >= 100
    monkeypatch.setenv("TMPDIR", str(tmp_path / "missing"))
    with pytest.raises(FlightLogError) as caught:
        FlightLog.read([place])
    assert caught.value.code == "no_room"


def test_too_little_memory_is_one_sentence(place, monkeypatch):
    def finish(_self):
        raise MemoryError

    place.write_bytes(SMALL)
    monkeypatch.setattr(LogIndex, "finish", finish)
    with pytest.raises(FlightLogError) as caught:
        FlightLog.read([place])
    assert caught.value.code == "no_memory"


def test_a_chunk_that_claims_more_than_it_may_have_is_not_expanded(place):
    for claimed in (MAX_CHUNK + 1, 1 << 63, 7):
        content = struct.pack("<QQQII", 0, 0, claimed, 0, 4) + b"zstd"
        content += struct.pack("<Q", len(ZSTD_BOMB)) + ZSTD_BOMB
        count, codes = codes_of(place, head() + record(6, content) + message())
        assert (count, codes) == (1, ["chunk_skipped", "cut_off"])


def test_without_zstandard_the_remedy_is_named(place, monkeypatch):
    monkeypatch.setattr(compression, "zstandard", None)
    place.write_bytes(official(CompressionType.ZSTD))
    with pytest.raises(FlightLogError) as caught:
        FlightLog.read([place])
    assert caught.value.code == "no_zstandard"
