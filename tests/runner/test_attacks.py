"""Every attack on the runner's requests starts nothing, and something once its rule is removed."""

import json

import pytest
from twisted.internet.defer import Deferred, succeed

from tests.cogs.peers import Server, connect
from tests.support.reactor import reactor, run_in_reactor, until
from tests.support.removed_rules import no_counter, no_direction, no_mac
from up.config.keys_file import KeyConfig, add_key, revoke_key
from up.protocols import aircraft_sessions, envelope
from up.protocols.general_message import encode
from up.protocols.ground_session import GroundSession
from up.protocols.pairing import Pairing
from up.protocols.runner_session import RunnerSession, body_of, to_line
from up_runner import instances, request_connection, request_server
from up_runner.config import KeyQuota, RunnerConfig
from up_runner.instance_machine import State
from up_runner.instances import KeyStarts
from up_runner.request_gate import RequestGate
from up_runner.response import Response
from up_runner.runner import Runner
from up_simulator.phone import address

SPAWN = b'{"aircraft": "glider-1"}'
PLACE = b'{"running": true, "ports": {"general": 1, "orientation": 1}, "code": null}'
STATUS = b'{"aircraft": "glider-1", "action": "status"}'


def same_random(m):
    """The same nonces and numbers in every session and in every life of the runner."""
    constant = lambda size: bytes([7]) * size  # noqa: E731
    real = aircraft_sessions.AircraftSessions.__init__
    m.setattr(
        aircraft_sessions.AircraftSessions,
        "__init__",
        lambda a, name, clock: real(a, name, clock, constant),
    )


def no_refusal(m):
    m.setattr(KeyConfig, "refusal", lambda *_: "")


def all_permitted(m):
    m.setattr(request_server, "refusal_of", lambda *_: None)


def plain_taken(m):
    m.setattr(RequestGate, "requires_key", lambda *_: False)


def no_quota(m):
    m.setattr(KeyStarts, "count", lambda *_: None)


def a_name_for_both(m):
    m.setattr(request_connection, "RUNNER", "glider-1")


def client_takes_plain(m):
    m.setattr(RunnerSession, "result", lambda _, line: line)


def shared_sessions(m):
    made = aircraft_sessions.AircraftSessions("runner:", lambda: 0)
    m.setattr(request_connection, "AircraftSessions", lambda *_: made)


class Started:
    """An instance without a process."""

    state, pid = State.RUNNING, 1

    def __init__(self, request, *_, **__):
        self.name, self.request = request.aircraft, request

    def start(self):
        return succeed(None)

    def response(self, *, spawned, error=None):
        return Response(self.name, self.pid, {"general": 1, "orientation": 1}, spawned, error)

    def detach(self):
        pass


class Scene:
    """A real runner on a real socket; `started` counts the starts that it carries out."""

    def __init__(self, folder, m, *, role="pilot", aircraft="glider-1", not_after="", quota=None):
        self.folder, self.started, self.codes = folder, 0, set()
        m.setattr(instances, "Instance", Started)
        self.quota = quota or KeyQuota()
        key_id, key = add_key(folder, "phone", role, not_after, aircraft)
        self.pairing = Pairing("glider-1", key_id, key.secret, role, "phone")
        self._peers = []

    async def start(self):
        config = RunnerConfig(
            port=0, address="127.0.0.1", i_accept_root=True, security="require",
            stop_instances_on_exit=False, run_folder=str(self.folder / "run"), key_quota=self.quota,
        )  # fmt: skip
        self.runner = Runner(reactor, config, self.folder, {})
        real = self.runner.instances.spawn

        async def spawn(request):
            response = await real(request)
            self.started += response.error is None
            return response

        self.runner.instances.spawn = spawn
        self.runner.start()

    async def stop(self):
        for peer in self._peers:
            await peer.close()
        await self.runner.stop()

    async def peer(self):
        self._peers.append(await connect(reactor, self.runner.port))
        return self._peers[-1]

    async def ask(self, peer, *lines):
        """Send lines and return the answer to the last one, after all of them."""
        wanted = len(peer.lines) + len(lines)
        peer.say(*lines)
        await until(lambda: len(peer.lines) >= wanted, what="answers")
        return peer.lines[-1]

    async def opened(self):
        """Open a session as the phone does; return it, the connection and the hello."""
        session, peer = RunnerSession(self.pairing), await self.peer()
        hello = session.hello()
        return session, peer, hello, await self.ask(peer, hello)

    async def captured(self, request=SPAWN):
        """Return the lines of a request that was carried out, and its connection."""
        session, peer, hello, answer = await self.opened()
        line = session.request(answer, request)
        result = json.loads(session.result(await self.ask(peer, line)))
        self.codes.add(result["code"])
        return hello, line, peer


def bodies(line, count):
    """Return a protected line with counters that rise."""
    body = body_of(json.loads(line))
    return [
        body[:5] + (counter + 1).to_bytes(8, "big") + body[13:]
        for counter in range(1, count + 1)
    ]  # fmt: skip


async def forged(s):
    session, peer, _, answer = await s.opened()
    line = session.request(answer, SPAWN)
    tries = [to_line(each[:13] + bytes(16) + each[29:]) for each in bodies(line, 30)]
    await s.ask(peer, *tries)
    return s.started, len(tries)


async def changed_field(s):
    """A query becomes a start, or gets another profile."""
    _, line, peer = await s.captured(STATUS)
    others = SPAWN, b'{"aircraft": "glider-1", "profile": "cub"}'
    heads = bodies(line, 2)
    await s.ask(
        peer, *(to_line(head[:29] + each) for head, each in zip(heads, others, strict=True))
    )
    return s.started, 2


async def replay(s):
    _, line, peer = await s.captured()
    await s.ask(peer, *[line] * 20)
    return s.started - 1, 20


async def replay_in_a_later_session(s):
    hello, line, _ = await s.captured()
    peer = await s.peer()
    await s.ask(peer, hello, line)
    return s.started - 1, 1


async def replay_after_a_restart(s):
    hello, line, _ = await s.captured()
    await s.stop()
    await s.start()
    peer = await s.peer()
    await s.ask(peer, hello, line)
    return s.started - 1, 1


async def other_connection(s):
    """The request of an open session, first on the attacker's own connection."""
    session, _, _, answer = await s.opened()
    peer = await s.peer()
    await s.ask(peer, session.request(answer, SPAWN))
    return s.started, 1


async def reflect(s):
    """What the runner sends, back to it."""
    _, _, peer = await s.captured()
    before = s.started
    lines = [line + b"\n" for line in peer.lines]
    await s.ask(peer, *lines)
    return s.started - before, len(lines)


async def honest(s):
    """A correct request, which its key may not make."""
    session, peer, _, answer = await s.opened()
    try:
        line = session.request(answer, SPAWN)
    except envelope.EnvelopeError:
        return s.started, 1
    await s.ask(peer, line)
    return s.started, 1


async def wrong_aircraft(s):
    await s.captured(b'{"aircraft": "glider-2"}')
    return s.started, 1


async def revoked(s):
    """Within the open session."""
    session, peer, _, answer = await s.opened()
    seen = s.runner._keys._stamp
    revoke_key(s.folder, "phone")
    await until(lambda: s.runner._keys._stamp != seen, what="the file is read")
    await s.ask(peer, session.request(answer, SPAWN))
    return s.started, 1


async def plain(s):
    for line in (SPAWN + b"\n", b"{}\n", b"spawn\n"):
        await s.ask(await s.peer(), line)
    return s.started, 3


async def command_of_the_aircraft(s):
    """A Command to the aircraft, under the same key: a request that names no aircraft."""
    ground = GroundSession("glider-1", *map(bytes.fromhex, (s.pairing.key_id, s.pairing.secret)))
    peer = await s.peer()
    answer = json.loads(await s.ask(peer, to_line(ground.hello())))
    if "body" in answer:
        ground.on_handshake(body_of(answer))
        await s.ask(peer, to_line(ground.seal(encode("up.arm", {}, "1")[:-1])))
    return s.started, 1


async def too_many(s):
    for number in range(3):
        await s.captured(b'{"aircraft": "glider-%d"}' % number)
    return s.started - 1, 2


async def false_answer(s, forge=lambda _: PLACE + b"\n"):
    """The relay between phone and runner answers the request itself."""
    server = Server(reactor)
    runner = address.Runner("127.0.0.1", await server.open(), "glider-1", s.pairing)
    found = Deferred.fromCoroutine(address.spawn(reactor, runner))
    relay = await server.peer()
    await until(lambda: relay.lines)
    answer = await s.ask(await s.peer(), relay.lines[0] + b"\n")
    relay.say(answer + b"\n")
    await until(lambda: len(relay.lines) == 2)
    relay.say(forge(body_of(json.loads(relay.lines[1]))))
    try:
        await found
    except address.NotFoundError as refusal:
        s.codes.add(refusal.code)
    await server.close()
    return len(s.codes) == 0, 1


async def forged_answer(s):
    """The request itself, with another payload."""
    return await false_answer(s, lambda body: to_line(body[:29] + PLACE))


FLEET = {"aircraft": ""}
SCENES = {
    "forged": (forged, no_mac, "forged", {}),
    "changed_field": (changed_field, no_mac, "forged", {}),
    "replay": (replay, no_counter, "replayed", {}),
    "later_session": (replay_in_a_later_session, same_random, "unknown_session", {}),
    "after_a_restart": (replay_after_a_restart, same_random, "unknown_session", {}),
    "other_connection": (other_connection, shared_sessions, "unknown_session", {}),
    "reflect": (reflect, no_direction, "forged", FLEET),
    "command_of_the_aircraft": (command_of_the_aircraft, a_name_for_both, "forged", FLEET),
    "wrong_aircraft": (wrong_aircraft, all_permitted, "wrong_aircraft", {}),
    "observer": (honest, all_permitted, "forbidden", {"role": "observer"}),
    "operator": (honest, all_permitted, "forbidden", {"role": "operator"}),
    "revoked": (revoked, no_refusal, "revoked", {}),
    "expired": (honest, no_refusal, "expired", {"not_after": "2020-01-01"}),
    "plain": (plain, plain_taken, "unprotected", {}),
    "starts": (too_many, no_quota, "key_starts", {**FLEET, "quota": KeyQuota(4, 1)}),
    "instances": (too_many, no_quota, "key_instances", {**FLEET, "quota": KeyQuota(1, 100)}),
    "false_answer": (false_answer, client_takes_plain, "unprotected", {}),
    "forged_answer": (forged_answer, no_mac, "forged", {}),
}


@pytest.mark.parametrize("rule", ["kept", "removed"])
@pytest.mark.parametrize("name", SCENES)
def test_an_attack_succeeds_only_without_its_rule(short_path, monkeypatch, name, rule):
    attack, remove, code, scene = SCENES[name]
    if rule == "removed":
        remove(monkeypatch)

    async def run():
        s = Scene(short_path, monkeypatch, **scene)
        await s.start()
        achieved, tries = await attack(s)
        await s.stop()
        return achieved, tries, s.codes | set(s.runner.server.counts)

    achieved, tries, codes = run_in_reactor(run)
    print(f"{name}: {tries} tries, {achieved} accepted with the rule {rule}")
    assert (achieved > 0) == (rule == "removed")
    assert rule == "removed" or code in codes
