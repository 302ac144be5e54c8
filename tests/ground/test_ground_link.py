"""The link's reactions to received lines, without a network."""

import pytest
from twisted.internet.task import Clock

from up_ground.ground_link import GroundLink
from up_ground.link_status import LinkState
from up_ground.settings import Seat, Settings
from up_ground.token_store import TokenStore

TOKEN = "0123456789abcdef" * 2


class Connection:
    """A connection that only records."""

    dropped_too_long = 0

    def __init__(self):
        self.sent, self.given_up, self.is_accepted = [], "", False

    def send(self, line):
        self.sent.append(line)
        return True

    def accept(self):
        self.is_accepted = True

    def abort(self, reason, code):
        self.given_up = code

    def round_trip_ms(self):
        return 4.0


class Bench:
    def __init__(self, folder, **settings):
        self.messages, self.changes = [], 0
        chosen = Settings(**settings)
        self.tokens = TokenStore(folder, chosen)
        self.link = GroundLink(Clock(), chosen, self, self.tokens)
        self.status = self.link.status
        self.connection = Connection()
        self.link.on_made(self.connection)

    def on_message(self, message):
        self.messages.append(message.name)

    def on_link(self):
        self.changes += 1

    def hear(self, *lines):
        for line in lines:
            if line.startswith(b"UP1 "):
                self.link.on_control(self.connection, line)
            else:
                self.link.on_line(self.connection, line)


@pytest.fixture
def bench(tmp_path):
    bench = Bench(tmp_path, seat=Seat.COMMAND)
    yield bench
    bench.tokens.close()


def ok(seat):
    return f"UP1 ok aircraft=default seat={seat} token={TOKEN}".encode()


def test_the_hello_must_be_answered_first(bench):
    bench.hear(b"UP1 seat holder=1")
    assert bench.status.strange_control == 1
    assert not bench.status.is_open
    assert not bench.link.send(b"early\n")
    bench.hear(b'{"name": "a"}')
    assert bench.connection.given_up == "no_proxy"
    assert bench.messages == []


def test_the_answer_opens_it_once(bench):
    bench.hear(ok("command"), b"UP1 aircraft online", b"UP1 seat holder=1")
    assert bench.connection.is_accepted
    assert bench.status.is_open
    assert bench.status.seat is Seat.COMMAND
    assert (bench.status.is_aircraft_online, bench.status.holder) == (True, 1)
    bench.hear(ok("listen"))
    assert bench.status.seat is Seat.COMMAND
    assert bench.status.strange_control == 1


def test_what_is_no_message_is_dropped_and_counted(bench):
    bench.hear(ok("command"), b"garbage", b'{"name": "a", "data": {"x": NaN}}', b"\xff", b"[]")
    bench.hear(b"UP1 nonsense", b'{"name": "a"}')
    assert bench.status.malformed == 4
    assert bench.status.strange_control == 1
    assert bench.status.dropped == 5
    assert bench.messages == ["a"]


@pytest.mark.parametrize("line", [b"\x01\x1b", b"\x01\x1bx", b"\x01abcd", b"\x02\x1b"])
def test_a_binary_line_that_is_damaged_is_dropped_and_counted(bench, line):
    bench.hear(ok("listen"), line)
    assert bench.status.malformed + bench.status.keyless + bench.status.unprotected == 1
    assert bench.messages == []


def test_the_seat_comes_and_goes_with_its_token(bench):
    bench.hear(ok("listen"))
    assert not bench.link.give_seat(2)
    assert not bench.link.release_seat()
    assert bench.link.request_seat()
    bench.hear(b"UP1 seat command token=" + TOKEN.encode(), b"UP1 seat asked by=2")
    assert bench.status.seat is Seat.COMMAND
    assert bench.status.asked_by == 2
    assert bench.tokens.load() == TOKEN
    assert bench.link.give_seat(2)
    bench.hear(b"UP1 seat listen")
    assert bench.status.seat is Seat.LISTEN
    assert bench.status.asked_by is None
    assert bench.tokens.load() is None
    assert bench.connection.sent == [b"UP1 seat request\n", b"UP1 seat give to=2\n"]


def test_a_lost_connection_leaves_nothing_known(bench):
    bench.hear(ok("command"), b"UP1 aircraft online", b"UP1 seat holder=1")
    bench.link.measure()
    assert bench.status.round_trip_ms == 4.0
    bench.link.on_lost(bench.connection, "gone", "lost")
    status = bench.status
    assert (status.state, status.code, status.failures) == (LinkState.WAITING, "lost", 1)
    assert (status.seat, status.holder, status.is_aircraft_online) == (None, None, None)
    assert status.round_trip_ms is None
    assert not bench.link.send(b"late\n")


def test_a_refusal_is_kept_for_people(bench):
    bench.hear(b'UP1 error code=full reason="no room"')
    assert bench.status.rejection == "full"
    assert bench.connection.given_up == "rejected"


def test_a_direct_link_obeys_no_control_lines(tmp_path):
    bench = Bench(tmp_path, direct=True)
    assert bench.status.is_open
    bench.hear(
        b"UP1 seat listen", ok("listen"), b'UP1 error code=full reason="x"', b'{"name": "a"}'
    )
    assert bench.status.seat is None
    assert bench.status.strange_control == 3
    assert bench.connection.given_up == ""
    assert bench.messages == ["a"]
    assert not bench.link.request_seat()
