"""A system with the phone's modules, on the real reactor."""

from android_cog.commands.android_commands import AndroidBatteryLowCommand, AndroidSpeakCommand
from android_cog.modules.android_battery_provider import AndroidBatteryProvider
from android_cog.modules.android_provider import AndroidProvider

from tests.cogs.peers import connect
from tests.support.reactor import reactor
from tests.support.system import build_up
from up.commands.roles import Role
from up.life_cycle import BootStoppedError, LifeCycle
from up.mode import Mode
from up.protocols.general_message import decode

PORTS = "general port: 0\norientation port: 0\naddress: 127.0.0.1\n"


class Flight:
    """Built, started, and stopped again; ``heard`` has the published Commands of chosen types."""

    def __init__(self, folder, text="", mode=Mode.AUTO, ports=PORTS):
        config = {"android.yml": ports + text}
        modules = (AndroidProvider, AndroidBatteryProvider)
        self.up = build_up(modules, reactor, folder, mode=mode, config=config)
        for cls in (AndroidSpeakCommand, AndroidBatteryLowCommand):
            self.up.command_executor.registry.add(cls)
        self.provider = self.up.get_module(AndroidProvider)
        self.heard = []
        self.peers = []

    async def __aenter__(self):
        self.life = LifeCycle(self.up)
        try:
            await self.life.start()
        except BootStoppedError:
            await self.life.stop()
            raise
        return self

    async def __aexit__(self, *_):
        for peer in self.peers:
            await peer.close()
        await self.life.stop()

    def listen_to(self, *commands):
        for cls in commands:
            self.up.command_executor.register_command(cls, self.heard.append)

    async def phone(self):
        peer = await connect(reactor, self.up.ports["general"])
        self.peers.append(peer)
        return peer

    async def gyro(self):
        peer = await connect(reactor, self.up.ports["orientation"])
        self.peers.append(peer)
        return peer

    @property
    def telemetry(self):
        return self.up.telemetry_controller.collect()


class Asker:
    """A link of a ground peer, and its answers."""

    def __init__(self, up, name, role=Role.OPERATOR):
        self.up = up
        self.sent = []
        self.link = up.open_link(name, role, self.sent.append, role_key="x.yml: role")

    def ask(self, line):
        self.up.command_receiver.receive(decode(line), self.link)

    def speak(self, id_, text="turn"):
        self.ask(
            b'{"name": "android.speak", "data": {"text": "%s"}, "id": "%s"}'
            % (text.encode(), id_.encode())
        )

    @property
    def answers(self):
        return [decode(line) for line in self.sent]
