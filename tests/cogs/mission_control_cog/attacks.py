"""The attacks of a hostile relay: each returns how much it achieved, and how often it tried."""

from tests.cogs.mission_control_cog.hostile_relay import Ground, pair
from tests.support.reactor import reactor, until
from up.config.keys_file import revoke_key
from up.protocols.binary_line import HANDSHAKE, to_body, to_line
from up.protocols.envelope import BROADCAST, HEADER_BYTES, place_of
from up.protocols.general_message import MalformedMessage, decode, encode
from up.protocols.handshake import Answer, Hello

BODY_AT = HEADER_BYTES + 1


def with_place(body, number, counter):
    return body[:1] + number.to_bytes(4, "big") + counter.to_bytes(8, "big") + body[13:]


async def deliver(s, *bodies, lines=False):
    """Send lines to the aircraft, and wait until it has taken them."""
    provider = s.aircraft.provider
    taken, wanted = [], len(bodies)
    real, plain = provider.protection.receive, provider._on_message

    def receive(*args):
        real(*args)
        taken.append(1)

    def receive_plain(message):
        plain(message)
        taken.append(1)

    provider.protection.receive = receive
    uplink = provider._uplink
    uplink._on_message, before = receive_plain, uplink._on_message
    for body in bodies:
        s.relay.to_air(body if lines else to_line(body)[:-1])
    await until(lambda: len(taken) >= wanted, what="delivery")
    provider.protection.receive, uplink._on_message = real, before


async def hold_down(s):
    """Hold back what the aircraft sends, and wait until the ground has read all before that."""
    s.relay.on_down = s.relay.hold
    status = s.ground.status
    before = status.unprotected + status.malformed
    s.relay.to_ground(b"{}")
    await until(lambda: status.unprotected + status.malformed > before)


async def captured(s, *, hold=True):
    """Let the ground send Arm without an id, and return the line's body."""
    await s.ground.ready()
    if hold:
        s.relay.on_up = s.relay.hold
    seen = len(s.relay.up)
    assert s.ground.send()
    await until(lambda: len(s.relay.up) > seen)
    s.relay.on_up = s.relay.to_air
    if not hold:
        await until(lambda: s.armed)
    return to_body(s.relay.up[-1])


async def forged(s):
    body = await captured(s)
    number, counter = place_of(body)
    tries = [
        with_place(body[:13] + bytes((value,)) * 16 + body[BODY_AT:], number, counter + value)
        for value in range(1, 50)
    ]
    await deliver(s, *tries)
    return s.armed, len(tries)


async def changed_field(s):
    """A telemetry period that no pilot set, in place of a Command held back."""
    body = await captured(s)
    beacon = s.ground.telemetry.beacon
    number, counter = place_of(body)
    tries = [
        with_place(body[:BODY_AT] + encode("up.arm", {}, f"{i}", beacon)[:-1], number, counter + i)
        for i in range(1, 30)
    ]
    await deliver(s, *tries)
    return s.armed, len(tries)


async def cut_and_splice(s):
    """The header of a harmless Command before the payload of an old Arm."""
    arm = await captured(s, hold=False)
    s.relay.on_up = s.relay.hold
    s.ground.send("up.telemetry.frequency", {"frequency": 100})
    await until(lambda: to_body(s.relay.up[-1]) != arm)
    await deliver(s, to_body(s.relay.up[-1])[:BODY_AT] + arm[BODY_AT:])
    return s.armed - 1, 1


async def replay(s):
    body = await captured(s, hold=False)
    await deliver(s, *[body] * 20)
    return s.armed - 1, 20


async def replay_in_a_later_session(s):
    body = await captured(s, hold=False)
    await s.ground.link.stop()
    s.ground = Ground(s.folder, s.ground_port, s.pairing)
    await s.ground.ready()
    await deliver(s, *[body] * 20)
    return s.armed - 1, 20


async def reorder(s):
    first = await captured(s)
    second = await captured(s)
    await deliver(s, second, first)
    return s.armed - 1, 1


async def reflect(s):
    """What the aircraft sends, back to it: it is taken if it reaches the Command Receiver."""
    await s.ground.ready()
    s.ground.send(id_="a")
    await until(lambda: s.ground.answers("a"))
    before = s.received
    answer = next(line for line in s.relay.down if line[0] == HANDSHAKE)
    places = [(place_of(to_body(line))[0], line) for line in s.relay.protected(s.relay.down)]
    frame = next(line for number, line in places if number & BROADCAST)
    ack = next(line for number, line in places if not number & BROADCAST)
    lines = [answer, frame, ack]
    await deliver(s, *lines, lines=True)
    return s.received - before, len(lines)


async def hold_back(s):
    """An Arm that arrives 3 s after it was sent: the clock of the aircraft's beacons moves."""
    body = await captured(s)
    beacons = s.aircraft.up.beacons
    clock = beacons._clock

    class Later:
        def seconds(self):
            return clock.seconds() + 3.0

    beacons._clock = Later()
    await deliver(s, body)
    beacons._clock = clock
    return s.armed, 1


async def strip(s):
    body = await captured(s)
    await deliver(s, body[BODY_AT:], lines=True)
    return s.armed, 1


async def downgrade(s):
    """Only plain lines arrive: the ground takes no telemetry and sends nothing."""
    await s.ground.ready()
    await hold_down(s)
    frames = s.ground.frames
    seen = frames + s.ground.status.unprotected
    for beacon in range(20):
        plain = encode("up.telemetry.update", {}, None, s.ground.telemetry.beacon + beacon)
        s.relay.to_ground(plain[:-1])
    await until(lambda: s.ground.status.unprotected + s.ground.frames - seen >= 20)
    return s.ground.frames - frames, 20


async def fake_ack(s):
    """The relay answers an Arm itself and does not deliver it."""
    await captured(s)
    s.relay.on_down = s.relay.hold
    number, _ = place_of(to_body(s.relay.up[-1]))
    ack = encode("up.ack", {"id": "a"})[:-1]
    own = b"\x02" + bytes(BODY_AT - 1) + ack
    refused = s.ground.status.refused
    tries = [with_place(own, number, counter) for counter in range(1, 20)]
    for body in tries:
        s.relay.to_ground(to_line(body)[:-1])
    taken = s.ground.answers
    await until(lambda: s.ground.status.refused - refused + len(taken("a")) >= len(tries))
    return len(taken("a")), len(tries)


async def old_telemetry(s):
    """Old frames are repeated as if they were live."""
    await s.ground.ready()
    await until(lambda: s.ground.frames >= 4)
    await hold_down(s)
    frames, refused = s.ground.frames, s.ground.status.refused
    old = [line for line in s.relay.down if line[0] == 2][:3]
    for line in old:
        s.relay.to_ground(line)
    await until(lambda: s.ground.status.refused - refused + s.ground.frames - frames >= 3)
    return s.ground.frames - frames, 3


async def late_telemetry(s):
    """Every frame arrives 3 s late from the beginning; the ground must not call it live.

    Instead of waiting, the stamp of each authenticated frame is 3 s older.
    """
    await s.ground.ready()
    telemetry = s.ground.telemetry
    telemetry.on_clock(s.ground.status.clock)
    before = telemetry.frames
    real = s.ground.on_message

    def later(message):
        stamp_ms = message.data["system"]["clock_ms"]
        message.data["system"]["clock_ms"] = stamp_ms - 3000
        real(message)

    s.ground.on_message = later
    now = reactor.seconds
    await until(lambda: telemetry.frames >= before + 1 or s.ground.frames > 10)
    await until(lambda: s.ground.frames > 10)
    return int(telemetry.frames > before and not telemetry.is_silent(now())), 1


async def wrong_aircraft(s):
    """The scene's aircraft has another name and a copy of the keys."""
    await until(lambda: s.counters or s.ground.status.key_role)
    return int(bool(s.ground.status.key_role)), 1


async def revoked(s):
    """A device that ignores the refusal."""
    body = await captured(s)
    revoke_key(s.folder / "air", "tablet")
    await until(lambda: s.aircraft.provider._keys._configured[s.pairing.key_id].revoked)
    await deliver(s, body)
    return s.armed, 1


async def expired(s):
    """Also with the aircraft's clock set back by a year: see the scene's removal."""
    await until(lambda: s.ground.status.key_refusal or s.ground.status.key_role)
    if s.ground.status.key_role:
        await until(lambda: s.ground.telemetry.beacon)
        s.ground.send(id_="a")
        await until(lambda: s.ground.answers("a"))
    return s.armed, 1


async def role_raised(s):
    """An observer's device that names other roles."""
    await s.ground.ready()
    beacon = s.ground.telemetry.beacon
    for number, more in enumerate(({"role": "admin"}, {"_origin": "ground (admin)"}, {})):
        line = encode("up.arm", more, f"r{number}", beacon)
        s.ground.link.send(line[:-2] + b', "role": "admin", "origin": "internal"}\n')
    await until(lambda: all(s.ground.answers(f"r{n}") for n in range(3)))
    return s.armed, 3


async def id_collision(s):
    """An observer uses the id of a pilot's Arm first, so that it counts as refused."""
    await s.ground.ready()
    other = Ground(s.folder / "b", s.ground_port, pair(s.folder / "air", "observer", "spy"))
    before = s.relay.ends["command"]
    await until(lambda: other.status.key_role and other.telemetry.beacon)
    other.send(id_="x")
    await until(lambda: other.answers("x"))
    s.relay.ends["command"] = before
    s.ground.send(id_="x")
    (answer,) = await until(lambda: s.ground.answers("x"))
    await other.link.stop()
    return int(answer.name != "up.ack"), 1


async def restarted_aircraft(s):
    """Hello and Arm of the life before, to the aircraft after its restart."""
    body = await captured(s, hold=False)
    hello = next(line for line in s.relay.up if line[0] == HANDSHAKE)
    await s.ground.link.stop()
    await s.aircraft.__aexit__()
    del s.relay.ends["air"]
    await s.start_aircraft(s.air_port)
    await until(lambda: s.aircraft.provider.connected)
    await deliver(s, to_body(hello), body)
    return s.armed, 1


async def restarted_ground(s):
    """Answer and telemetry of the life before, to a ground that has started again."""
    await s.ground.ready()
    await until(lambda: s.ground.frames >= 3)
    s.relay.on_down = s.relay.hold
    old = s.relay.down[:4]
    await s.ground.link.stop()
    s.relay.on_up = s.relay.hold
    del s.relay.ends["command"]
    s.ground = Ground(s.folder, s.ground_port, s.pairing)
    seen = len(s.relay.up)
    await until(lambda: len(s.relay.up) > seen)
    for line in old:
        s.relay.to_ground(line)
    sent = len(old)
    s.relay.to_ground(b"{}")
    await until(lambda: s.ground.status.unprotected)
    return s.ground.frames, sent


def readable(lines):
    """Return how many protected lines show their message to the relay."""
    count = 0
    for line in lines:
        try:
            count += decode(to_body(line)[BODY_AT:]) is not None
        except MalformedMessage:
            continue
    return count


async def read(s):
    """The relay reads a Command, its answer and the telemetry of a session."""
    await s.ground.ready()
    s.ground.send(id_="a")
    await until(lambda: s.ground.answers("a") and s.ground.frames >= 3)
    lines = s.relay.protected(s.relay.up + s.relay.down)[:5]
    return readable(lines), len(lines)


async def secrecy_stripped(s):
    """The relay drops the hello for secrecy, and repeats the plain one."""

    def without_secrecy(line):
        if line[0] != HANDSHAKE or line[1] == Hello.KIND:
            s.relay.to_air(line)

    def handshakes(lines):
        return [line for line in lines if line[0] == HANDSHAKE]

    s.relay.on_up = without_secrecy
    plain, *_ = await until(lambda: handshakes(s.relay.up))
    for _ in range(3):
        s.relay.to_air(plain)
    await until(lambda: len(handshakes(s.relay.down)) >= 4)
    return sum(line[1] == Answer.KIND for line in handshakes(s.relay.down)), 4


async def same_keystream(s):
    """The first Command of two lives of both sides begins with the same text."""
    first = await captured(s, hold=False)
    await s.ground.link.stop()
    await s.aircraft.__aexit__()
    s.relay.ends.clear()
    await s.start_aircraft(s.air_port)
    s.ground = Ground(s.folder, s.ground_port, s.pairing)
    second = await captured(s)
    beginning = slice(BODY_AT, BODY_AT + 16)
    return int(first[beginning] == second[beginning]), 1
