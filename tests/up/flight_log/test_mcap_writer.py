import io
import json
import struct
import zlib

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mcap.reader import SeekingReader, make_reader
from mcap.stream_reader import StreamReader

from tests.flightlog.logs import START_NS, LogMaker, small_log
from up.flight_log.compression import compressor
from up.flight_log.mcap_format import MAGIC
from up.flight_log.mcap_writer import McapWriter
from up.version import VERSION


def test_the_official_reader_reads_it():
    reader = make_reader(io.BytesIO(small_log()), validate_crcs=True)
    assert isinstance(reader, SeekingReader)
    assert reader.get_header().library == f"raspilot {VERSION}"
    messages = list(reader.iter_messages())
    assert len(messages) == 9
    schema, channel, message = messages[0]
    assert (schema.name, schema.encoding) == ("up.orientation.update", "jsonschema")
    assert json.loads(schema.data) == {"type": "object"}
    assert (channel.topic, channel.message_encoding) == ("up.orientation.update", "json")
    assert message.log_time == message.publish_time == START_NS
    assert json.loads(message.data) == {"roll": 0.0, "_origin": "arduino"}
    assert [m.sequence for _, c, m in messages if c.topic == "up.orientation.update"] == [*range(6)]


def test_the_summary_has_statistics_and_indexes():
    reader = make_reader(io.BytesIO(small_log()))
    summary = reader.get_summary()
    statistics = summary.statistics
    assert statistics.message_count == 9
    assert statistics.schema_count == statistics.channel_count == 2
    assert statistics.attachment_count == statistics.metadata_count == 1
    assert statistics.chunk_count == 0
    assert statistics.message_start_time == START_NS
    assert statistics.message_end_time == START_NS + 500_000_000
    assert statistics.channel_message_counts == {1: 6, 2: 3}
    assert {each.topic for each in summary.channels.values()} == {
        "up.orientation.update",
        "up.altitude.change",
    }
    assert len(summary.schemas) == 2
    (attachment,) = reader.iter_attachments()
    assert (attachment.name, attachment.media_type) == ("config/pids.yml", "text/yaml")
    assert attachment.data == b"rate: 2.0\n"
    (metadata,) = reader.iter_metadata()
    assert metadata.name == "flight"
    assert metadata.metadata == {"aircraft": "glider-1", "host": "pi"}


def test_every_checksum_is_right():
    # With a wrong one the official reader raises CRCValidationError (see the reader's tests).
    data = small_log()
    footer = list(StreamReader(io.BytesIO(data), validate_crcs=True).records)[-1]
    assert type(footer).__name__ == "Footer"
    # The official reader checks no checksum of the summary: from its start up to the checksum.
    until = len(data) - len(MAGIC) - 4
    assert footer.summary_crc == zlib.crc32(data[footer.summary_start : until])
    assert data[footer.summary_offset_start] == 0x0E


def test_each_call_is_one_write_of_whole_records():
    writes = []
    writer = McapWriter(writes.append)
    writer.start()
    channel = writer.add_channel("a", writer.add_schema("a", {}))
    writer.message(channel, 1, b"{}")
    writer.message(channel, 2, b"{}")
    writer.add_metadata("m", {"a": "b"})
    writer.add_attachment("f", "text/plain", b"x", 3)
    writer.finish()
    assert len(writes) == 8
    assert writer.size == sum(map(len, writes))
    for record in writes[1:-1]:
        assert len(record) == 9 + struct.unpack_from("<Q", record, 1)[0]
    assert writes[0].startswith(MAGIC)
    assert writes[-1].endswith(MAGIC)
    messages = [m for _, _, m in make_reader(io.BytesIO(b"".join(writes))).iter_messages()]
    assert [(m.log_time, m.publish_time) for m in messages] == [(1, 1), (2, 2)]


def test_chunks_hold_what_the_official_reader_finds_in_an_uncompressed_file():
    def write(compress) -> tuple[bytearray, list[int]]:
        out = bytearray()
        writer = McapWriter(out.extend, compress=compress)
        writer.start()
        in_chunks = []
        for number in range(200):
            if number % 50 == 0:
                writer.add_metadata(f"m{number}", {})
                channel = writer.add_channel(f"t{number}", writer.add_schema("a", {}))
            writer.message(channel, 1000 - number % 7, b'{"roll": %d}' % number)
            if number % 20 == 19:
                in_chunks.append(writer.end_chunk())
        writer.finish()
        return out, in_chunks

    plain, none = write(None)
    packed, in_chunks = write(compressor())
    assert (sum(none), sum(in_chunks)) == (0, 200)
    assert len(packed) < len(plain)
    found = [
        [(c.topic, m) for _, c, m in make_reader(io.BytesIO(each)).iter_messages(None)]
        for each in (plain, packed)
    ]
    assert found[0] == found[1]
    assert len(found[0]) == 200
    list(StreamReader(io.BytesIO(packed), validate_crcs=True).records)
    chunks = [each for each in StreamReader(io.BytesIO(packed), emit_chunks=True).records]
    chunks = [each for each in chunks if type(each).__name__ == "Chunk"]
    statistics = make_reader(io.BytesIO(packed)).get_summary().statistics
    assert statistics.chunk_count == len(chunks) == 10
    assert (statistics.message_start_time, statistics.message_end_time) == (994, 1000)
    assert {(each.message_start_time, each.message_end_time) for each in chunks} == {(994, 1000)}


def test_a_failed_write_does_not_count():
    out = bytearray()
    is_full = False

    def write(data):
        if is_full:
            out.extend(data[: len(data) // 2])
            raise OSError(28, "No space left on device")
        out.extend(data)

    writer = McapWriter(write)
    writer.start()
    channel = writer.add_channel("a", 0)
    writer.message(channel, 1, b"{}")
    is_full = True
    for fails in (
        lambda: writer.message(channel, 2, b"{}"),
        lambda: writer.add_channel("b", 0),
        lambda: writer.add_metadata("m", {}),
        lambda: writer.add_attachment("f", "", b"", 0),
        writer.finish,
    ):
        with pytest.raises(OSError, match="No space"):
            fails()
    is_full = False
    del out[writer.size :]
    writer.message(channel, 3, b"{}")
    writer.finish()
    reader = make_reader(io.BytesIO(out), validate_crcs=True)
    assert [(m.log_time, m.sequence) for _, _, m in reader.iter_messages()] == [(1, 0), (3, 1)]
    assert reader.get_summary().statistics.channel_count == 1
    list(StreamReader(io.BytesIO(out), validate_crcs=True).records)


def test_times_out_of_order():
    maker = LogMaker()
    for time_s in (5, 2, 9, 3):
        maker.add(time_s, "a")
    statistics = make_reader(io.BytesIO(maker.finished())).get_summary().statistics
    assert statistics.message_start_time == START_NS + 2_000_000_000
    assert statistics.message_end_time == START_NS + 9_000_000_000


def test_a_log_without_messages():
    out = bytearray()
    writer = McapWriter(out.extend)
    writer.start()
    writer.finish()
    statistics = make_reader(io.BytesIO(out)).get_summary().statistics
    assert (statistics.message_count, statistics.message_start_time) == (0, 0)


@pytest.mark.parametrize(("channel", "time_ns"), [(0, 1), (2, 1), (-1, 1), (1, -1), (1, 2**64)])
def test_values_out_of_range_are_rejected(channel, time_ns):
    out = bytearray()
    writer = McapWriter(out.extend)
    writer.start()
    writer.add_channel("a", 0)
    size = len(out)
    with pytest.raises(ValueError, match=f"channel {channel}"):
        writer.message(channel, time_ns, b"{}")
    with pytest.raises(ValueError, match="7"):
        writer.add_channel("a", 7)
    with pytest.raises(ValueError, match="-1 ns"):
        writer.add_attachment("a", "", b"", -1)
    assert len(out) == size


def test_channels_are_bounded():
    writer = McapWriter(lambda data: None)
    for _ in range(65535):
        writer.add_channel("a", 0)
    with pytest.raises(ValueError, match="65535"):
        writer.add_channel("a", 0)


texts = st.text(max_size=20)


@given(
    topics=st.lists(texts, min_size=1),
    messages=st.lists(st.tuples(st.integers(0, 2**64 - 1), st.binary(max_size=50))),
    metadata=st.dictionaries(texts, texts, max_size=3),
)
def test_the_official_reader_reads_any_content(topics, messages, metadata):
    out = bytearray()
    writer = McapWriter(out.extend)
    writer.start()
    channels = [writer.add_channel(topic, 0) for topic in topics]
    for number, (time_ns, data) in enumerate(messages):
        writer.message(channels[number % len(channels)], time_ns, data)
    writer.add_metadata("m", metadata)
    writer.finish()
    reader = make_reader(io.BytesIO(out), validate_crcs=True)
    told = [(m.log_time, m.data) for _, _, m in reader.iter_messages(log_time_order=False)]
    assert told == messages
    summary = reader.get_summary()
    assert [c.topic for c in summary.channels.values()] == topics
    assert next(reader.iter_metadata()).metadata == metadata


def test_a_lone_surrogate_is_replaced():
    out = bytearray()
    writer = McapWriter(out.extend)
    writer.start()
    writer.add_metadata("flight", {"host": "a\udcffb"})
    writer.finish()
    assert next(make_reader(io.BytesIO(out)).iter_metadata()).metadata == {"host": "a?b"}
