import io
import os
import re
from pathlib import Path

import pytest
from twisted.logger import Logger, LogLevel, LogPublisher
from twisted.python.failure import Failure

from up.log.levels import level_named
from up.log.text import TextObserver, is_journal, journal_lines, terminal_lines


def logged(say, least=LogLevel.info, journal=False, namespace="serial_cog.port"):
    """Return the output of `say(log)`."""
    stream = io.StringIO()
    observer = TextObserver(stream, least, journal_lines if journal else terminal_lines)
    say(Logger(namespace=namespace, observer=LogPublisher(observer)))
    return stream.getvalue()


def failure_of(error):
    try:
        raise error
    except type(error):
        return Failure()


def test_an_event_is_one_line_with_time_level_source_and_text():
    line = logged(lambda log: log.warn("opened {port} at {baud}", port="/dev/x", baud=9600))
    assert re.fullmatch(
        r"\d\d:\d\d:\d\d\.\d{3} WARNING  serial_cog\.port: opened /dev/x at 9600\n", line
    )


def test_in_the_journal_it_is_a_priority_without_a_time():
    def say(log):
        log.debug("d")
        log.info("i")
        log.warn("w")
        log.error("e")
        log.critical("c")

    assert logged(say, LogLevel.debug, journal=True).splitlines() == [
        "<7>serial_cog.port: d",
        "<6>serial_cog.port: i",
        "<4>serial_cog.port: w",
        "<3>serial_cog.port: e",
        "<2>serial_cog.port: c",
    ]


def test_what_is_below_the_level_is_left_out():
    def say(log):
        log.debug("one")
        log.info("two")
        log.warn("three")
        log.error("four")

    assert [line[-5:].strip() for line in logged(say, LogLevel.warn).splitlines()] == [
        "three",
        "four",
    ]


def test_what_twisted_says_about_itself_is_for_debugging():
    def say(log):
        log.info("Starting factory")
        log.warn("trouble")

    assert "Starting" not in logged(say, namespace="twisted.internet.protocol")
    assert "trouble" in logged(say, namespace="twisted.internet.protocol")
    assert "Starting" in logged(say, LogLevel.debug, namespace="twisted.internet.protocol")


def test_text_from_a_peer_can_neither_forge_a_line_nor_steer_a_terminal():
    text = logged(lambda log: log.info("{name}", name="a\n12:00:00.000 ERROR x\r\x1b[2J\u2028\x9b"))
    assert text.count("\n") == 1
    assert text[:-1].isprintable()


def test_a_long_text_is_cut():
    assert len(logged(lambda log: log.info("{x}", x="y" * 100_000))) < 5000


def test_an_expected_failure_is_one_sentence():
    failure = failure_of(OSError(2, "missing"))
    text = logged(lambda log: log.error("cannot open", log_failure=failure))
    assert text.endswith("cannot open: [Errno 2] missing\n")
    assert text.count("\n") == 1


def test_an_expected_failure_without_words_names_its_type():
    text = logged(lambda log: log.error("cannot open", log_failure=failure_of(TimeoutError())))
    assert text.endswith("cannot open: TimeoutError\n")


def test_an_expected_failure_shows_its_traceback_when_everything_is_logged():
    failure = failure_of(OSError(2, "No such file"))
    text = logged(lambda log: log.error("cannot open", log_failure=failure), LogLevel.debug)
    assert "test_text.py" in text


@pytest.mark.parametrize(("journal", "head"), [(False, "    "), (True, "<2>    ")])
def test_a_bug_shows_its_traceback(journal, head):
    def say(log):
        try:
            raise ZeroDivisionError("division\nby zero")
        except ZeroDivisionError:
            log.failure("in {module}", module="gps")

    lines = logged(say, LogLevel.error, journal).splitlines()
    assert lines[0].endswith("in gps: division\\nby zero")
    assert all(line.startswith(head) for line in lines[1:])
    assert any("test_text.py" in line for line in lines)


def test_an_event_that_cannot_be_formatted_is_still_a_line():
    assert logged(lambda log: log.info("{missing}")).count("\n") == 1


class AsciiStream(io.StringIO):
    def write(self, text):
        text.encode("ascii")
        return super().write(text)


def test_a_stream_that_only_takes_ascii_gets_escapes():
    stream = AsciiStream()
    observer = TextObserver(stream, LogLevel.info, terminal_lines)
    Logger(namespace="x", observer=observer).info("žluť")
    assert stream.getvalue().endswith("x: \\u017elu\\u0165\n")


def test_a_full_or_closed_stream_raises_nothing():
    with Path("/dev/full").open("w") as full:
        observer = TextObserver(full, LogLevel.info, terminal_lines)
        observer({"log_format": "x", "log_time": 0.0, "log_level": LogLevel.info})
        # Data still in the stream's buffer must have a destination when it closes.
        with Path(os.devnull).open("w") as null:
            os.dup2(null.fileno(), full.fileno())
    observer({"log_format": "x", "log_time": 0.0, "log_level": LogLevel.info})


def test_the_journal_is_known_by_its_device_and_inode(tmp_path):
    with (tmp_path / "journal").open("w") as stream:
        status = os.fstat(stream.fileno())
        named = f"{status.st_dev}:{status.st_ino}"
        assert is_journal(stream, {"JOURNAL_STREAM": named})
        assert not is_journal(stream, {"JOURNAL_STREAM": "1:2"})
        assert not is_journal(stream, {"JOURNAL_STREAM": "rubbish"})
        assert not is_journal(stream, {})
    assert not is_journal(stream, {"JOURNAL_STREAM": named})
    assert not is_journal(io.StringIO(), {"JOURNAL_STREAM": named})


@pytest.mark.parametrize(
    ("name", "level"),
    [
        ("debug", LogLevel.debug),
        ("INFO", LogLevel.info),
        ("warn", LogLevel.warn),
        ("Warning", LogLevel.warn),
        ("error", LogLevel.error),
    ],
)
def test_levels_have_the_names_of_the_configuration(name, level):
    assert level_named(name) is level


def test_a_class_is_called_by_its_bare_name():
    line = logged(lambda log: log.warn("x"), namespace="some_cog.modules.serial.SerialProvider")
    assert line.endswith("WARNING  SerialProvider: x\n")
