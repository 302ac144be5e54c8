"""Messages of pages, invalid ones included, without a network."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.ground.web.hub import KEY, Bench
from up_ground.web.client_hub import FAULTS_LIMIT, GREETING_LIMIT, HELLO_S, KEPT_S, LATER, VIOLATION
from up_ground.web.client_session import PAGES_LIMIT, WATCHERS_LIMIT


@pytest.fixture
def bench():
    return Bench()


def test_hello_comes_first(bench):
    link = bench.open(hello=False)
    bench.send(link, type="watch", aircraft="kite")
    assert link.told[0]["type"] == "fault"
    assert bench.kite.heard == []
    bench.send(link, type="hello", name="Ann")
    assert link.kinds()[1:] == ["welcome", "status"]
    bench.send(link, type="hello", name="Ann")
    assert link.told[-1]["code"] == "hello_repeated"


def test_who_says_no_hello_is_closed(bench):
    link = bench.open(hello=False)
    bench.send(link, type="ping", ping=1)
    bench.clock.advance(HELLO_S)
    assert link.closed[0] == VIOLATION


@pytest.mark.parametrize(
    "payload",
    [
        b"",
        b"nonsense",
        b"[]",
        b"7",
        b'"hello"',
        b"null",
        b"{}",
        b'{"type": 7}',
        b'{"type": "nothing"}',
        b'{"type": "watch"}',
        b'{"type": "watch", "aircraft": 7}',
        b'{"type": "watch", "aircraft": "none"}',
        b'{"type": "watch", "aircraft": "kite", "aircraft": "kite"}',
        b'{"type": "control", "aircraft": "kite", "action": "take"}',
        b'{"type": "control", "aircraft": "kite", "action": "give", "to": "x"}',
        b'{"type": "control", "aircraft": "kite", "action": "give", "to": 1e300}',
        b'{"type": "command", "aircraft": "kite", "ask": true, "name": "x"}',
        b'{"type": "command", "aircraft": "kite", "ask": 1.5, "name": "x"}',
        b'{"type": "command", "aircraft": "kite", "ask": 1, "name": "x", "data": []}',
        b'{"type": "command", "aircraft": "kite", "ask": 1, "name": "x", "beacon": "1"}',
        b'{"type": "command", "aircraft": "kite", "ask": 9007199254740993, "name": "x"}',
        b'{"type": "replay", "action": "seek", "value": NaN}',
        b'{"type": "replay", "action": "seek", "value": "1"}',
        b'{"type": "ping", "ping": {}}',
        b'{"type": "hello\\ud800"}',
        b"\xff\xfe",
        b"[" * 60000,
        b'{"type": "ping", "ping": ' + b"[" * 40 + b"]" * 40 + b"}",
        b'{"a":' * 5000 + b"1" + b"}" * 5000,
        b'{"type": "ping", "x": "' + b"y" * (1 << 20) + b'"}',
    ],
)
def test_nonsense_is_a_fault_and_nothing_else(bench, payload):
    link = bench.open()
    before = len(link.told)
    bench.pages.on_message(link, payload)
    (fault,) = link.told[before:]
    assert fault["type"] == "fault"
    assert 3 < len(fault["text"]) <= 300
    assert link.closed is None


def test_too_much_nonsense_ends_it(bench):
    link = bench.open()
    for _ in range(FAULTS_LIMIT):
        assert link.closed is None
        bench.pages.on_message(link, b"nonsense")
    assert link.closed[0] == VIOLATION


def test_a_flood_ends_it(bench):
    link = bench.open()
    for _ in range(1000):
        bench.send(link, type="ping", ping=1)
    assert link.closed[0] == VIOLATION
    other = bench.open()
    for _ in range(3000):
        bench.clock.advance(0.02)
        bench.send(other, type="ping", ping=1)
    assert other.closed is None


_VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20),
    lambda inner: (
        st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner, max_size=4)
    ),
    max_leaves=12,
)
_KINDS = st.sampled_from(["hello", "watch", "control", "command", "replay", "ping", "pair", "x"])
_KEYS = st.sampled_from(
    ["aircraft", "action", "to", "ask", "name", "data", "beacon", "value", "ping", "key", "token"]
)
_FIELDS = st.dictionaries(_KEYS, _VALUES | st.sampled_from(["kite", "request", "give"]))


@given(st.lists(st.tuples(_KINDS, _FIELDS), max_size=5))
def test_whatever_a_page_says_is_answered_or_done(said):
    bench = Bench(key=KEY)
    link = bench.open()
    for kind, fields in said:
        bench.pages.on_message(link, json.dumps({**fields, "type": kind}).encode())
    assert link.closed is None
    for message in link.told:
        json.dumps(message, allow_nan=False)


def test_a_page_that_was_away_is_itself_again(bench):
    link = bench.open()
    token, number = link.told[0]["token"], link.told[0]["page"]
    bench.pages.on_closed(link)
    bench.clock.advance(KEPT_S - 0.1)
    again = bench.open(token=token)
    assert again.told[0]["page"] == number
    bench.clock.advance(60)
    assert ("gone", number) not in bench.kite.heard
    bench.pages.on_closed(again)
    bench.clock.advance(KEPT_S)
    assert bench.kite.heard[-1] == ("gone", number)
    late = bench.open(token=token)
    assert late.told[0]["page"] != number


def test_a_page_whose_old_link_hangs_takes_its_place(bench):
    old = bench.open()
    old.alive = False
    again = bench.open(token=old.told[0]["token"])
    assert again.told[0]["page"] == old.told[0]["page"]
    assert old.closed[0] == 4001
    bench.pages.on_closed(old)
    bench.clock.advance(60)
    assert ("gone", 1) not in bench.kite.heard


def test_a_wrong_token_is_a_new_page(bench):
    first = bench.open()
    for token in ("", "x", "\u20ac", first.told[0]["token"][:-1]):
        assert bench.open(token=token).told[0]["page"] != 1


def test_names_are_made_harmless(bench):
    link = bench.open(hello=False)
    bench.send(link, type="hello", name=" <b>\u202e\n\x00" + "x" * 150)
    name = link.told[0]["name"]
    assert name.isprintable()
    assert len(name) <= 40


def test_there_are_so_many_pages_and_no_more(bench):
    links = [bench.open() for _ in range(PAGES_LIMIT)]
    assert bench.open().closed[0] == LATER
    assert all(link.closed is None for link in links)
    bench.pages.on_closed(links[0])
    # Its place is kept while it may come back; then it is anybody's.
    assert bench.open().closed is not None
    bench.clock.advance(KEPT_S)
    assert bench.open().kinds()[0] == "welcome"


def test_the_page_that_comes_back_finds_its_place_in_a_full_house(bench):
    first = bench.open()
    for _ in range(PAGES_LIMIT - 1):
        bench.open()
    bench.pages.on_closed(first)
    assert bench.open().closed is not None
    again = bench.open(token=first.told[0]["token"])
    assert again.told[0]["page"] == first.told[0]["page"]
    assert again.closed is None


def test_only_a_page_that_may_control_sends_a_whole_plan():
    bench = Bench(key=KEY)
    watcher, pilot = bench.open(), bench.open(session=bench.sign_in())
    assert (watcher.max_bytes, pilot.max_bytes) == (1 << 16, 1 << 20)
    assert [each.told[0]["max_message"] for each in (watcher, pilot)] == [1 << 16, 1 << 20]


def test_watchers_leave_places_for_those_who_may_control():
    bench = Bench(key=KEY)
    watchers = [bench.open() for _ in range(WATCHERS_LIMIT)]
    assert bench.open().closed[0] == LATER
    pilots = [bench.open(session=bench.sign_in()) for _ in range(PAGES_LIMIT - WATCHERS_LIMIT)]
    assert all(link.closed is None for link in (*watchers, *pilots))
    # A full house: the youngest watcher goes, and does not come back by its token.
    assert bench.open(session=bench.sign_in()).told[0]["may_control"] is True
    assert watchers[-1].closed[0] == LATER
    assert all(link.closed is None for link in watchers[:-1])
    assert ("gone", WATCHERS_LIMIT) in bench.kite.heard
    bench.pages.on_closed(watchers[-1])
    assert bench.open(token=watchers[-1].told[0]["token"]).closed is not None
    for _ in range(WATCHERS_LIMIT - 1):
        assert bench.open(session=bench.sign_in()).closed is None
    assert bench.open(session=bench.sign_in()).closed[0] == LATER
    assert len(bench.pages.all()) == PAGES_LIMIT


def test_where_nobody_may_control_all_places_are_for_watchers():
    bench = Bench(is_watch_only=True)
    assert all(bench.open().closed is None for _ in range(PAGES_LIMIT))
    assert bench.open().closed is not None


def test_links_that_say_nothing_keep_nobody_out(bench):
    silent = [bench.open(hello=False) for _ in range(GREETING_LIMIT)]
    assert bench.open().kinds()[0] == "welcome"
    assert silent[0].closed[0] == LATER
    assert silent[1].closed is None
    bench.pages.on_closed(silent[0])
    for link in silent[1:]:
        bench.pages.on_closed(link)


def test_comings_and_goings_leave_nothing(bench):
    for _ in range(300):
        link = bench.open()
        bench.pages.on_closed(link)
    assert len(bench.pages.all()) == 0
    bench.clock.advance(KEPT_S)
    assert bench.clock.getDelayedCalls() == []
