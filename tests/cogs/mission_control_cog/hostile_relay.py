"""A relay that obeys its attacker, between a real aircraft and real ground links."""

from pathlib import Path

from twisted.internet.protocol import Factory, Protocol

from tests.cogs.mission_control_cog.system import Aircraft
from tests.support.reactor import reactor, run_in_reactor, until
from up.commands.arming_commands import ArmCommand
from up.config.keys_file import add_key
from up.protocols.binary_line import PROTECTED, to_body
from up.protocols.general_message import encode
from up.protocols.line_decoder import LineDecoder
from up.protocols.pairing import Pairing
from up_ground.ground_link import GroundLink
from up_ground.settings import Seat, Settings
from up_ground.telemetry import NAME as TELEMETRY
from up_ground.telemetry import Telemetry
from up_ground.token_store import TokenStore

TOKEN = "ab" * 16


class _End(Protocol):
    """One side of the relay: answers the hello, then every line is the attacker's."""

    def __init__(self, relay, seat):
        self.relay, self.seat, self.lines = relay, seat, LineDecoder()
        self.is_greeted = False

    def dataReceived(self, data):  # noqa: N802
        for line in self.lines.feed(data):
            if not self.is_greeted:
                self.is_greeted = True
                ok = f"UP1 ok aircraft=default seat={self.seat} token={TOKEN}\n"
                self.transport.write(ok.encode())
                self.relay.ends[self.seat] = self
            elif self.seat == "air":
                self.relay.down.append(line)
                self.relay.on_down(line)
            elif not line.startswith(b"UP1 "):
                self.relay.up.append(line)
                self.relay.on_up(line)


class Relay:
    """`up` and `down` are the lines seen; `on_up` and `on_down` decide what becomes of each."""

    def __init__(self):
        self.ends, self.up, self.down, self._ports = {}, [], [], []
        self.on_up, self.on_down = self.to_air, self.to_ground

    def listen(self, seat):
        factory = Factory()
        factory.noisy = False
        factory.buildProtocol = lambda _: _End(self, seat)
        self._ports.append(reactor.listenTCP(0, factory, interface="127.0.0.1"))
        return self._ports[-1].getHost().port

    def to_air(self, line):
        self.ends["air"].transport.write(line + b"\n")

    def to_ground(self, line):
        if "command" in self.ends:
            self.ends["command"].transport.write(line + b"\n")

    def hold(self, line):
        """Keep a line; it is in `up` or `down`."""

    def protected(self, lines):
        return [line for line in lines if line[0] == PROTECTED]

    async def close(self):
        for end in self.ends.values():
            end.transport.abortConnection()
        for port in self._ports:
            await port.stopListening()


class Ground:
    """A ground link that keeps what it accepts."""

    def __init__(self, folder, port, pairing, aircraft="default", tls=None, host="127.0.0.1"):
        settings = Settings(host, port, aircraft, Seat.COMMAND, pairing=pairing, tls=tls)
        self.link = GroundLink(reactor, settings, self, TokenStore(folder / "state", settings))
        self.status = self.link.status
        self.telemetry, self.messages, self.frames = Telemetry(), [], 0
        self.link.start()

    def on_message(self, message):
        if message.name == TELEMETRY:
            self.telemetry.update(message, reactor.seconds())
            self.frames += 1
        else:
            self.messages.append(message)

    def on_link(self):
        pass

    def send(self, name="up.arm", data=None, id_=None, beacon=None):
        beacon = self.telemetry.beacon if beacon is None else beacon
        return self.link.send(encode(name, data or {}, id_, beacon))

    def answers(self, id_):
        return [m for m in self.messages if m.data.get("id") == id_]

    async def ready(self):
        await until(lambda: self.status.key_role and self.telemetry.beacon, what="a session")


def pair(folder, role="pilot", name="tablet", aircraft="default", not_after=""):
    """Add a key on the aircraft, and return what its device stores."""
    Path(folder).mkdir(parents=True, exist_ok=True)
    key_id, key = add_key(folder, name, role, not_after)
    return Pairing(aircraft, key_id, key.secret, role, name)


class Scene:
    """An aircraft, a hostile relay and a paired ground; `armed` counts the carried out Arms."""

    def __init__(self, folder, *, text="role: pilot\n", security="require", role="pilot",
                 not_after="", air_name="default"):  # fmt: skip
        self.folder, self.text, self.security = folder, text, security
        self.air_name = air_name
        self.pairing = pair(folder / "air", role, not_after=not_after)
        self.relay = Relay()

    async def __aenter__(self):
        self.ground_port = self.relay.listen("command")
        await self.start_aircraft(self.relay.listen("air"))
        self.ground = Ground(self.folder, self.ground_port, self.pairing)
        return self

    async def start_aircraft(self, port):
        self.air_port = port
        text = f"aircraft: {self.air_name}\n{self.text}"
        self.aircraft = Aircraft(self.folder / "air", port, text, security=self.security)
        self.aircraft.listen_to(ArmCommand)
        self.aircraft.up.get_module(type(self.aircraft.provider))
        await self.aircraft.__aenter__()
        await until(lambda: "air" in self.relay.ends)

    async def __aexit__(self, *_):
        await self.ground.link.stop()
        await self.aircraft.__aexit__()
        await self.relay.close()

    @property
    def armed(self):
        return len(self.aircraft.heard)

    @property
    def counters(self):
        return self.aircraft.provider.protection.counters

    @property
    def received(self):
        return self.aircraft.up.command_receiver.counters["received"]

    async def settle(self):
        """Wait until the aircraft has taken all that was sent to it: it answers in order."""
        before = len(self.relay.down)
        beacon = self.ground.telemetry.beacon
        await until(lambda: len(self.relay.down) >= before + 3 and beacon is not None)


def body_of(line):
    return to_body(line)


def fly(body, *args, **more):
    """Run `body(scene)` with a scene of these arguments, and return its result."""

    async def run():
        async with Scene(*args, **more) as scene:
            return await body(scene)

    return run_in_reactor(run)
