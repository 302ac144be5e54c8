import io
import json
import tracemalloc

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.writer import CompressionType
from mcap.writer import Writer as OfficialWriter

from tests.flightlog.logs import START_NS, LogMaker, small_log
from up.flight_log.mcap_format import MAGIC, FlightLogError
from up_flightlog.read.flight_log import FlightLog, LoggedMessage
from up_flightlog.read.log_summary import summary_topics

SMALL = small_log()


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("logs")


def read(folder, *parts: bytes) -> FlightLog:
    paths = []
    for number, data in enumerate(parts, 1):
        paths.append(folder / f"flight.{number}.mcap")
        paths[-1].write_bytes(data)
    return FlightLog.read(paths)


def codes(log: FlightLog) -> list[str]:
    return [each.code for each in log.problems]


def test_metadata_attachments_and_schemas(folder):
    log = read(folder, SMALL)
    assert log.topics == {"up.orientation.update": 6, "up.altitude.change": 3}
    assert log.start_unix_s == START_NS / 1e9
    assert log.length_s == pytest.approx(0.5)
    assert log.is_complete
    assert log.problems == []
    assert log.metadata == {"flight": {"aircraft": "glider-1", "host": "pi"}}
    assert log.attachments["config/pids.yml"].read() == b"rate: 2.0\n"
    assert log.schema("up.orientation.update") == {"type": "object"}
    assert log.schema("nothing") is None


def test_messages_in_the_order_of_time(folder):
    log = read(folder, SMALL)
    everything = list(log.messages())
    assert len(everything) == 9
    assert everything[0] == LoggedMessage(
        "up.orientation.update", 0.0, {"roll": 0.0, "_origin": "arduino"}
    )
    times = [each.time_s for each in everything]
    assert times == sorted(times)
    altitudes = list(log.messages("up.altitude.change"))
    assert [each.data["altitude"] for each in altitudes] == [101, 103, 105]
    assert list(log.messages("up.altitude.change", "up.orientation.update")) == everything
    assert list(log.messages("nothing")) == []
    assert log.times("up.altitude.change") == pytest.approx([0.1, 0.3, 0.5])


def test_messages_since_a_time(folder):
    log = read(folder, SMALL)
    assert [each.time_s for each in log.messages(since_s=0.35)] == pytest.approx([0.4, 0.5, 0.5])
    late = log.messages("up.altitude.change", since_s=0.3)
    assert [each.data["altitude"] for each in late] == [103, 105]
    assert list(log.messages(since_s=99)) == []


def test_messages_of_some_topics_since_a_time(folder):
    maker = LogMaker()
    for number, topic in enumerate("abcbacab"):
        maker.add(number, topic, x=number)
    found = maker.log(folder).messages("a", "b", since_s=2.5)
    assert [(each.topic, each.data["x"]) for each in found] == [
        ("b", 3),
        ("a", 4),
        ("a", 6),
        ("b", 7),
    ]


def test_a_series_has_finite_numbers_only(folder):
    maker = LogMaker()
    values = [1, 2.5, None, True, "3", [4], {"b": 5}, 10**400, -3]
    for number, value in enumerate(values):
        maker.add(number, "t", a={"b": value}, c=value)
    log = maker.log(folder)
    assert log.series("t", "a.b") == ([0.0, 1.0, 8.0], [1.0, 2.5, -3.0])
    assert log.series("t", "c.b") == ([6.0], [5.0])
    assert log.series("t", "a.b.c") == ([], [])
    assert log.series("t", "") == ([], [])
    assert log.series("other", "a") == ([], [])


def test_a_whole_number_beyond_a_float_is_left_out_alone(folder):
    maker = LogMaker()
    for number, value in enumerate([1, 10**400, 2.5]):
        maker.add(number, "t", a=value)
    assert maker.log(folder).series("t", "a") == ([0.0, 2.0], [1.0, 2.5])


def test_several_parts_of_one_flight(folder):
    first, second = LogMaker(), LogMaker()
    first.writer.add_metadata("flight", {"aircraft": "a", "host": "one"})
    second.writer.add_metadata("flight", {"aircraft": "b", "more": "x"})
    second.writer.add_metadata("other", {})
    first.writer.add_attachment("f", "", b"first", 0)
    second.writer.add_attachment("f", "", b"second", 0)
    # Another order of topics: other numbers of channels.
    first.add(0, "a", x=1)
    first.add(1, "b", x=2)
    second.add(2, "b", x=3)
    second.add(3, "c", x=4)
    second.add(4, "a", x=5)
    log = read(folder, first.finished(), second.finished())
    assert [(m.topic, m.time_s, m.data["x"]) for m in log.messages()] == [
        ("a", 0.0, 1),
        ("b", 1.0, 2),
        ("b", 2.0, 3),
        ("c", 3.0, 4),
        ("a", 4.0, 5),
    ]
    assert log.topics == {"a": 2, "b": 2, "c": 1}
    assert log.metadata == {"flight": {"aircraft": "a", "host": "one", "more": "x"}, "other": {}}
    assert log.attachments["f"].read() == b"first"
    assert log.is_complete


def test_messages_written_out_of_order_are_sorted(folder):
    first, second = LogMaker(), LogMaker()
    for time_s in (5, 3, 9):
        first.add(time_s, f"t{time_s}", x=time_s)
    for time_s in (4, 1, 3):
        second.add(time_s, "u", x=time_s)
    log = read(folder, first.finished(), second.finished())
    assert [(m.topic, m.data["x"]) for m in log.messages()] == [
        ("u", 1),
        ("t3", 3),
        ("u", 3),
        ("u", 4),
        ("t5", 5),
        ("t9", 9),
    ]
    assert log.start_unix_s == START_NS / 1e9 + 1
    assert log.length_s == 8.0
    assert log.series("u", "x") == ([0.0, 2.0, 3.0], [1.0, 3.0, 4.0])


def test_a_part_that_is_not_a_log_costs_only_itself(folder):
    log = read(folder, SMALL, b"")
    assert (sum(log.topics.values()), log.is_complete) == (9, False)
    assert codes(log) == ["empty"]
    assert "flight.2.mcap" in log.problems[0].text
    for paths, code in (([], "no_file"), ([folder / "flight.2.mcap"], "empty")):
        with pytest.raises(FlightLogError) as caught:
            FlightLog.read(paths)
        assert caught.value.code == code


def test_a_log_without_messages_is_empty(folder):
    log = LogMaker().log(folder)
    assert (log.start_unix_s, log.length_s, log.topics) == (0.0, 0.0, {})
    assert list(log.messages()) == []


@pytest.mark.parametrize(
    "data",
    [
        b"{",
        b"",
        b"[1]",
        b"\xff\xfe{\0",
        b'{"a": NaN}',
        b'{"a": [-Infinity]}',
        b'{"a": 1e999}',
        b'{"a": [{"b": -1e999}]}',
        b'{"a": 1E+999}',
        b'{"a": ' + b"9" * 400 + b".0}",
        b'{"a": "\\ud800"}',
        b'{"a": ' + b"[" * 100_000 + b"]" * 100_000 + b"}",
        b'{"a": ' + b"[" * 32 + b"]" * 32 + b"}",
        b'{"a": ' + b"9" * 5000 + b"}",
    ],
)
def test_a_message_that_is_not_a_json_object_is_counted_once(folder, data):
    maker = LogMaker()
    maker.add(0, "good", x=1)
    maker.raw(1, "bad", data)
    maker.add(2, "bad", x=2)
    maker.raw(3, "bad", data)
    log = maker.log(folder)
    assert log.problems == []
    for _ in range(2):
        assert [m.data["x"] for m in log.messages()] == [1, 2]
        assert log.series("bad", "x") == ([2.0], [2.0])
    assert codes(log) == ["messages_skipped"]
    assert log.problems[0].text.startswith("bad: 2 messages")


def test_nested_values(folder):
    maker = LogMaker()
    maker.raw(0, "t", b'{"a": ' + b"[" * 31 + b"]" * 31 + b', "b": "{{[[\\u00e4"}')
    log = maker.log(folder)
    assert next(log.messages()).data["b"] == "{{[[ä"
    assert log.problems == []


def test_files_of_other_programs(folder):
    out = io.BytesIO()
    writer = OfficialWriter(out, compression=CompressionType.NONE)
    writer.start()
    binary = writer.register_channel(
        "/imu", "cdr", writer.register_schema("sensor_msgs/Imu", "ros2msg", b"float64 x")
    )
    plain = writer.register_channel("/json", "json", 0)
    writer.add_message(binary, START_NS, b"\0\1\2", START_NS)
    writer.add_message(plain, START_NS, b'{"x": 1}', START_NS)
    writer.finish()
    log = read(folder, out.getvalue())
    assert log.topics == {"/imu": 1, "/json": 1}
    assert [m.data for m in log.messages()] == [{"x": 1}]
    assert log.schema("/imu") is None
    assert log.schema("/json") is None
    assert codes(log) == ["not_json"]


def test_an_unknown_channel_and_a_redeclared_channel(folder):
    maker = LogMaker()
    maker.add(0, "aa", x=1)
    channel = bytes(maker.out)[maker.out.index(b"\4" + (22).to_bytes(8, "little")) :][:31]
    assert b"aa" in channel
    maker.out += channel.replace(b"aa", b"bb")
    message = bytearray(maker.out[maker.out.index(b"\5" + (30).to_bytes(8, "little")) :][:39])
    message[9] = 7
    maker.out += message
    log = maker.log(folder, is_finished=False)
    assert [m.topic for m in log.messages()] == ["aa"]
    assert codes(log) == ["channel_redeclared", "unknown_channel", "cut_off"]


def test_a_file_that_changes_after_the_reading(folder):
    log = read(folder, SMALL)
    log.paths[0].write_bytes(SMALL[:100])
    with pytest.raises(FlightLogError) as caught:
        list(log.messages())
    assert caught.value.code == "truncated"
    log.paths[0].unlink()
    for reading in (lambda: list(log.messages()), log.attachments["config/pids.yml"].read):
        with pytest.raises(FlightLogError) as caught:
            reading()
        assert caught.value.code == "unreadable"


def test_one_part_at_a_time_is_in_memory_and_no_message_stays_there(folder):
    paths = [folder / "large.mcap", folder / "large-2.mcap"]
    data = json.dumps({"x": 1, "text": "y" * 4000}).encode()
    for path in paths:
        maker = LogMaker()
        for number in range(2500):
            maker.raw(number / 100, "t", data)
        path.write_bytes(maker.finished())
    del maker
    tracemalloc.start()
    try:
        log = FlightLog.read(paths)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.reset_peak()
        assert sum(1 for _ in log.messages()) == 5000
        assert len(log.series("t", "x")[1]) == 5000
        later = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert path.stat().st_size > 10e6
    assert (peak < path.stat().st_size + 2e6, later < 2e6) == (True, True)


@given(
    changes=st.lists(
        st.tuples(st.integers(len(MAGIC), len(SMALL) - 1), st.integers(0, 255)), max_size=8
    ),
    cut=st.integers(0, len(SMALL)),
)
def test_any_damage_gives_a_log_or_a_flight_log_error(folder, changes, cut):
    data = bytearray(SMALL)
    for at, byte in changes:
        data[at] = byte
    try:
        log = read(folder, bytes(data[:cut]))
        for message in log.messages():
            json.dumps(message.data, allow_nan=False)
        for topic in log.topics:
            log.series(topic, "roll")
            log.schema(topic)
        for attachment in log.attachments.values():
            attachment.read()
    except FlightLogError as error:
        assert cut < len(MAGIC)
        assert "\n" not in str(error)
    else:
        assert all("\n" not in each.text for each in log.problems)


names = st.text(min_size=1, max_size=8)
json_values = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats(allow_nan=False, allow_infinity=False)
    | names,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(names, inner, max_size=3),
    max_leaves=8,
)


@settings(max_examples=40, deadline=None)
@given(
    st.lists(
        st.tuples(
            st.integers(0, 10**9), st.sampled_from("abc"), st.dictionaries(names, json_values)
        ),
        max_size=20,
    ),
    st.integers(0, 20),
)
def test_written_messages_are_read(folder, messages, split):
    makers = LogMaker(), LogMaker()
    for number, (time_ns, topic, data) in enumerate(messages):
        maker = makers[number >= split]
        maker.writer.message(maker.channel(topic), START_NS + time_ns, json.dumps(data).encode())
    log = read(folder, *(maker.finished() for maker in makers))
    expected = sorted(messages, key=lambda each: each[0])
    first = expected[0][0] if expected else 0
    assert [(m.topic, m.data) for m in log.messages()] == [each[1:] for each in expected]
    told = [m.time_s for m in log.messages()]
    assert told == pytest.approx([(each[0] - first) / 1e9 for each in expected])
    for topic in "abc":
        assert [m.data for m in log.messages(topic)] == [d for _, t, d in expected if t == topic]


@settings(max_examples=50, deadline=None)
@given(
    times_ms=st.lists(st.integers(0, 3000), min_size=1, max_size=60),
    rate_hz=st.sampled_from([0.7, 1, 3, 10, 1000]),
)
def test_a_rate_leaves_the_newest_messages_before_each_tick(folder, times_ms, rate_hz):
    maker = LogMaker()
    for number, time_ms in enumerate(sorted([0, *times_ms])):
        maker.add(time_ms / 1000, "ab"[number % 2], number=number)
    log = maker.log(folder)

    def newest(messages, tick_s):
        return {each.topic: each.data for each in messages if each.time_s <= tick_s}

    everything, found = list(log.messages()), list(log.messages(rate_hz=rate_hz))
    for tick in range(int(log.length_s * rate_hz) + 1):
        assert newest(found, tick / rate_hz) == newest(everything, tick / rate_hz)
    assert len(found) <= 2 * (log.length_s * rate_hz + 2)


def test_the_topics_are_known_from_the_end_of_the_file_alone(tmp_path):
    path = tmp_path / "flight.mcap"
    whole = small_log()
    path.write_bytes(whole)
    assert summary_topics([path, path]) == set(FlightLog.read([path]).topics)
    # The lines before the summary are not read.
    path.write_bytes(whole[:20] + bytes(200) + whole[220:])
    assert summary_topics([path]) == {"up.orientation.update", "up.altitude.change"}
    for damaged in (whole[:-1], whole[:-40] + b"x" + whole[-39:], b"", MAGIC):
        path.write_bytes(damaged)
        assert summary_topics([path]) is None
