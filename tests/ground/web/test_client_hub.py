"""Messages of pages, invalid ones included, without a network."""

import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from twisted.internet.task import Clock

from up_ground.web.access import (
    ADDRESSES_KEPT,
    ATTEMPTS_RATE_HZ,
    MAX_ATTEMPTS,
    Access,
    KeyAttempts,
)
from up_ground.web.aircraft_source import AircraftSource
from up_ground.web.client_hub import (
    FAULTS_LIMIT,
    GREETING_LIMIT,
    HELLO_S,
    KEPT_S,
    LATER,
    VIOLATION,
    ClientHub,
)
from up_ground.web.client_session import PAGES_LIMIT, WATCHERS_LIMIT
from up_ground.web.sessions import MAX_SESSIONS, UNUSED_S, SignInError

KEY = "the-right-key"
PAIRING = f"upkey:1:kite:{'1' * 16}:{'2' * 64}:pilot:tablet"


class Output:
    def __init__(self):
        self.sent = []

    def send(self, message):
        self.sent.append(message)

    def send_newest(self, kind, make):
        self.sent.append(make())

    def discard(self, kind):
        pass


class Link:
    """A page's connection that remembers."""

    def __init__(self, host="192.0.2.1"):
        self.output, self.closed, self.alive = Output(), None, True
        self.host, self.is_admitted = host, False
        self.session, self.may_send_secrets = "", True

    def admit(self, max_bytes):
        self.is_admitted, self.max_bytes = True, max_bytes

    def close(self, code, reason):
        self.closed = (code, reason)

    def is_alive(self, within_s, notify):
        notify(self.alive)

    @property
    def told(self):
        """Return the messages, without the heads of their frames."""
        return [json.loads(each[each.index(b"{") :]) for each in self.output.sent]

    def kinds(self):
        return [each["type"] for each in self.told]


class Kite(AircraftSource):
    """An aircraft that records its requests."""

    name, summary = "kite", "kite"

    def __init__(self):
        self.heard = []

    def start(self):
        pass

    async def stop(self):
        pass

    def past(self):
        return []

    def status(self, page):
        return {"type": "status", "aircraft": "kite"}

    def on_control(self, page, action, to):
        self.heard.append((action, to))

    def on_command(self, page, message):
        self.heard.append(("command", message.whole("ask"), message.text("name", 128)))
        message.object("data")
        message.optional_whole("beacon")

    async def pair(self, page, pairing):
        self.heard.append(("pair", pairing.name))

    def on_replay(self, page, action, message):
        message.number("value")

    def on_away(self, page):
        self.heard.append(("away", page.number))

    def on_gone(self, page):
        self.heard.append(("gone", page.number))


class Bench:
    def __init__(self, **access):
        self.clock = Clock()
        self.pages = ClientHub(self.clock, Access(**access))
        self.kite = Kite()
        self.pages.fleet["kite"] = self.kite

    def open(self, hello=True, host="192.0.2.1", session="", **more):
        link = Link(host)
        link.session = session
        self.pages.on_opened(link)
        if hello:
            self.send(link, type="hello", name="Ann", **more)
        return link

    def sign_in(self, host="192.0.2.1"):
        return self.pages.sessions.sign_in(host, KEY)

    def denial(self, key, host):
        """Return the code with which a key is refused; None: it opens a session."""
        try:
            self.pages.sessions.sign_in(host, key)
        except SignInError as error:
            return error.code
        return None

    def send(self, link, **fields):
        self.pages.on_message(link, json.dumps(fields).encode())


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


@settings(max_examples=120, deadline=None)
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


def test_wrong_keys_are_limited_by_address():
    bench = Bench(key=KEY)
    token = bench.sign_in("2001:db8::1")
    for number in range(MAX_ATTEMPTS):
        # One network of IPv6 is one address.
        assert bench.denial(f"guess-{number}", f"2001:db8::{number + 1:x}") == "wrong_key"
    assert bench.denial("guess", "2001:db8::99") == "too_many_keys"
    # Otherwise a client that keeps guessing would see which guess was right.
    assert bench.denial(KEY, "2001:db8::1") == "too_many_keys"
    assert bench.denial(KEY, "2001:db8:0:1::1") is None
    # A page that has shown the key before is not limited.
    assert bench.open(session=token, host="2001:db8::1").told[0]["may_control"]
    bench.clock.advance(1 / ATTEMPTS_RATE_HZ)
    assert bench.denial(KEY, "2001:db8::1") is None


def test_right_keys_of_one_address_use_nothing_up():
    bench = Bench(key=KEY)
    assert [bench.denial(KEY, "192.0.2.1") for _ in range(3 * MAX_ATTEMPTS)] == [
        None for _ in range(3 * MAX_ATTEMPTS)
    ]


@pytest.mark.parametrize("access", [{}, {"key": KEY, "is_watch_only": True}])
def test_without_a_key_to_show_nobody_signs_in(access):
    assert Bench(**access).denial(KEY, "192.0.2.1") == "no_sign_in"


def test_an_unknown_token_is_no_session():
    bench = Bench(key=KEY)
    token = bench.sign_in()
    for wrong in ("", token[:-1], token + "x", token.swapcase(), "\ud800"):
        welcome = bench.open(session=wrong).told[0]
        assert (welcome["may_control"], welcome["signed_in"]) == (False, False)
    assert bench.sign_in() != token
    welcome = bench.open(session=token).told[0]
    assert (welcome["may_control"], welcome["signed_in"]) == (True, True)


def test_a_session_ends_some_time_after_its_last_page():
    bench = Bench(key=KEY)
    bench.pages.start()
    used, unused = bench.sign_in(), bench.sign_in()
    link = bench.open(session=used)
    for _ in range(4):
        bench.clock.pump([1.0, UNUSED_S / 2 - 1.0])
    bench.pages.on_closed(link)
    bench.clock.advance(UNUSED_S - 1)
    assert not bench.pages.sessions.use(unused)
    assert bench.pages.sessions.use(used)
    bench.clock.advance(UNUSED_S + 1)
    assert not bench.pages.sessions.use(used)


def test_of_too_many_sessions_the_least_used_ends():
    bench = Bench(key=KEY)
    first, second, *_ = [bench.sign_in() for _ in range(MAX_SESSIONS)]
    assert bench.pages.sessions.use(first)
    bench.sign_in()
    assert not bench.pages.sessions.use(second)
    assert bench.pages.sessions.use(first)
    assert len(bench.pages.sessions._used_s) == MAX_SESSIONS


def test_signing_out_takes_control_from_all_pages_of_the_session():
    bench = Bench(key=KEY)
    token, other = bench.sign_in(), bench.sign_in()
    mine, tab, theirs, watcher = (bench.open(session=each) for each in (token, token, other, ""))
    bench.pages.sign_out("")
    bench.pages.sign_out(token)
    assert [each.closed is None for each in (mine, tab, theirs, watcher)] == [0, 0, 1, 1]
    assert [each for each in bench.kite.heard if each[0] == "gone"] == [("gone", 1), ("gone", 2)]
    again = bench.open(session=token, token=mine.told[0]["token"])
    assert again.told[0]["may_control"] is False


def test_the_token_of_a_page_does_not_replace_its_session():
    bench = Bench(key=KEY)
    session = bench.sign_in()
    pilot = bench.open(session=session)
    token = pilot.told[0]["token"]
    bench.pages.on_closed(pilot)
    stranger = bench.open(token=token)
    assert stranger.told[0]["page"] != pilot.told[0]["page"]
    again = bench.open(session=session, token=token)
    assert again.told[0]["page"] == pilot.told[0]["page"]


def pair(bench, text=PAIRING, is_private=True, **more):
    """Return the answer to a pairing text."""
    link = bench.open(**more)
    link.may_send_secrets = is_private
    bench.send(link, type="pair", ask=1, pairing=text)
    answer = link.told[-1]
    assert (answer.pop("type"), answer.pop("ask")) == ("pair.answer", 1)
    assert "2222" not in json.dumps(link.told)
    return answer


def test_a_page_that_may_control_pairs(bench):
    assert pair(bench) == {
        "outcome": "ack", "aircraft": "kite", "key": "tablet", "role": "pilot",
    }  # fmt: skip
    assert bench.kite.heard == [("pair", "tablet")]


@pytest.mark.parametrize(
    ("more", "code"),
    [
        ({"is_private": False}, "not_private"),
        ({"text": PAIRING + " "}, None),
        ({"text": PAIRING.replace("kite", "crow")}, "unknown_aircraft"),
        ({"text": PAIRING.replace("pilot", "king")}, "pairing_invalid"),
        ({"text": "x" * 301}, "invalid"),
        ({"text": 7}, "invalid"),
        ({"text": None}, "invalid"),
    ],
)
def test_another_text_or_an_open_way_pairs_nothing(bench, more, code):
    assert pair(bench, **more).get("code") == code
    assert bool(bench.kite.heard) is (code is None)


def test_a_page_that_only_watches_pairs_nothing():
    bench = Bench(key=KEY)
    assert pair(bench)["code"] == "watch_only"
    assert pair(bench, session=bench.sign_in())["outcome"] == "ack"
    assert bench.kite.heard == [("pair", "tablet")]


def test_addresses_without_end_take_no_memory_without_end():
    attempts = KeyAttempts(Clock())
    for number in range(3 * ADDRESSES_KEPT):
        assert attempts.permits(f"10.0.{number // 256}.{number % 256}", False)
    assert len(attempts._known) == ADDRESSES_KEPT


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
