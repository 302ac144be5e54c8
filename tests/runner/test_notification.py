"""Notifications of instances, invalid ones included."""

from hypothesis import given, settings
from hypothesis import strategies as st

from up_runner.notification import MAX_BYTES, Notification, parse


def test_the_words_of_sd_notify_and_our_own():
    assert parse(b"READY=1\nSTATUS=12 modules run") == Notification(
        ready=True, status="12 modules run"
    )
    assert parse(b"WATCHDOG=1\nX_UP_PHONE=1") == Notification(alive=True, phone=True)
    assert parse(b"STOPPING=1") == Notification(stopping=True)
    assert parse(b"X_UP_PHONE=0\n") == Notification(phone=False)
    assert parse(b"X_UP_PORTS=general:50001 orientation:50000").ports == {
        "general": 50001,
        "orientation": 50000,
    }
    assert parse(b"X_UP_PORTS=").ports == {}


def test_what_is_malformed_says_nothing():
    nothing = Notification()
    for words in (
        b"",
        b"READY=0",
        b"READY",
        b"X_UP_PHONE=2",
        b"X_UP_PORTS=general",
        b"X_UP_PORTS=general:0",
        b"X_UP_PORTS=general:65536",
        b"X_UP_PORTS=general:-1",
        b"X_UP_PORTS=" + b" ".join(b"p%d:1" % number for number in range(17)),
        b"MAINPID=1",
    ):
        assert parse(words) == nothing, words


@settings(max_examples=1000)
@given(st.binary(max_size=300) | st.builds(lambda data: b"X_UP_PORTS=" + data, st.binary()))
def test_no_bytes_break_it(data):
    said = parse(data)
    for port in (said.ports or {}).values():
        assert 1 <= port <= 65535
    assert said.status is None or (said.status.isprintable() and len(said.status) <= 200)


def test_it_reads_no_more_than_its_limit():
    assert parse(b"x" * MAX_BYTES + b"\nREADY=1") == Notification()
