import json

import pytest
from twisted.internet.task import Clock

from tests.ground.web.hub import KEY, PAIRING, Bench
from up_ground.web.access import ADDRESSES_KEPT, ATTEMPTS_RATE_HZ, MAX_ATTEMPTS, KeyAttempts
from up_ground.web.sessions import MAX_SESSIONS, UNUSED_S


@pytest.fixture
def bench():
    return Bench()


def test_wrong_keys_are_limited_by_address():
    bench = Bench(key=KEY)
    token = bench.sign_in("2001:db8::1")
    for number in range(MAX_ATTEMPTS):
        # One network of IPv6 is one address.
        assert bench.denial(f"guess-{number}", f"2001:db8::{number + 1:x}") == ("wrong_key", 403)
    assert bench.denial("guess", "2001:db8::99") == ("too_many_keys", 429)
    # Otherwise a client that keeps guessing would see which guess was right.
    assert bench.denial(KEY, "2001:db8::1") == ("too_many_keys", 429)
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
    assert Bench(**access).denial(KEY, "192.0.2.1") == ("no_sign_in", 404)


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
