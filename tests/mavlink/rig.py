"""The MAVLink cog in an aircraft whose time a test advances; clients without sockets."""

from types import SimpleNamespace

from mavlink_cog.modules.mavlink import AirbornePort, MAVLink
from mission_control_cog.modules.mission_control_provider import MissionControlProvider
from pymavlink.dialects.v20 import common as m

from raspilot.flight_modes.land import Land
from raspilot.flight_modes.mission import Mission
from raspilot.flight_modes.return_home import Return
from raspilot.modules.plans import Plans
from tests.raspilot.navigation_rig import NavigationRig
from up.base_module import BaseModule
from up.commands.arming_commands import ArmCommand, DisarmCommand
from up.commands.pid_tunings_commands import PIDTuningsCommand, PIDTuningsValuesCommand
from up.commands.refusal import CommandRefusedError
from up.commands.roles import Role
from up.commands.telemetry_commands import TelemetryCommand
from up_mavlink.address import read_address
from up_mavlink.endpoint import Endpoint, Settings
from up_mavlink.personas import BY_NAME


class Tuner(BaseModule):
    """Keeps the gains that it gets, and arms unless there is a veto."""

    def on_init(self):
        self.armed = []
        gains = {"p": 1.0, "i": 0.0, "d": 0.5}
        axes = {axis: dict(gains) for axis in ("ailerons", "elevator", "rudder")}
        self.gains = {"ratePIDs": axes, "stabPIDs": {a: dict(g) for a, g in axes.items()}}
        executor = self.up.command_executor
        executor.register_command(PIDTuningsCommand, self.on_tunings)
        executor.register_command(ArmCommand, self.on_arm)
        executor.register_command(DisarmCommand, self.armed.append)

    def on_tunings(self, command):
        if command.request:
            values = PIDTuningsValuesCommand(self.gains)
            self.up.get_module(MissionControlProvider).send_command(values)
        else:
            self.gains = command.pids

    def on_arm(self, command):
        if self.up.vetoes.own:
            raise CommandRefusedError("arming is vetoed", detail="veto")
        self.armed.append(command)


class Client:
    """A ground station: sends messages, and reads what the endpoint sends."""

    def __init__(self, rig, endpoint, system=255, key=None, name=None):
        self.rig, self.endpoint = rig, endpoint
        self.mav = m.MAVLink(None, srcSystem=system, srcComponent=190)
        self.reader = m.MAVLink(None)
        self.reader.robust_parsing = True
        self.got = []
        self.is_deaf = False
        if key is not None:
            self.mav.signing.secret_key = key
            self.mav.signing.sign_outgoing = True
            self.mav.signing.timestamp = endpoint._signing.stamp
        self.session = endpoint.open(name or object(), self._take, endpoint.codec())

    def _take(self, packet):
        if not self.is_deaf:
            self.got += self.reader.parse_buffer(packet) or ()

    def pack(self, kind, *fields):
        packet = bytes(getattr(m, f"MAVLink_{kind}_message")(*fields).pack(self.mav))
        self.mav.seq = (self.mav.seq + 1) % 256
        return packet

    def send(self, kind, *fields):
        self.session.on_bytes(self.pack(kind, *fields))
        self.rig.settle()

    def command(self, number, *params, confirmation=0, target=1):
        given = [*params, *[0.0] * (7 - len(params))]
        self.send("command_long", target, 1, number, confirmation, *given)
        return self.result(number)

    def result(self, number):
        acks = [each for each in self.of("COMMAND_ACK") if each.command == number]
        return acks[-1].result if acks else None

    def of(self, kind):
        return [each for each in self.got if each.get_type() == kind]

    @property
    def texts(self):
        return [each.text for each in self.of("STATUSTEXT")]


class MAVRig(NavigationRig):
    def __init__(
        self, folder, role=Role.PILOT, persona="ardupilot", key=None, ground_id=None, modules=()
    ):
        super().__init__(
            folder, modes=(Return, Mission, Land), mission_control="listener: {port: 0}\n",
            modules=(Plans, MissionControlProvider, MAVLink, Tuner, *modules),
            mavlink="endpoints: [{url: 'tcpin:127.0.0.1:0'}]\n",
        )  # fmt: skip
        control = self.up.get_module(MissionControlProvider)
        self.ground.send_command = control.send_command
        self.module = self.up.get_module(MAVLink)
        self.plans = self.up.get_module(Plans)
        self.tuner = self.up.get_module(Tuner)
        port = AirbornePort(self.module, role, "mavlink.yml: endpoints.0.role")
        settings = Settings(read_address("tcpin:127.0.0.1:0"), BY_NAME[persona], 1, key, ground_id)
        port.endpoint = self.endpoint = Endpoint(self.clock, settings, port)
        self.module._endpoints.append((self.endpoint, role))
        self.state("FBW", armed=False, in_flight=False)
        self.setpoint()
        self.manager.home.set(SimpleNamespace(latitude_deg=48.0, longitude_deg=17.0,
                                              altitude_m=200.0), None)  # fmt: skip
        self.telemetry()

    def client(self, **more):
        return Client(self, self.endpoint, **more)

    def telemetry(self, **more):
        """Let a frame of telemetry leave; ``more`` is what modules report that are not here."""
        self.setpoint()
        controller = self.up.telemetry_controller
        content = {**controller.collect(), **more}
        self.bus.execute_command(TelemetryCommand(content, self.up.beacons.draw()))

    def fly(self):
        self.state("FBW")
        self.setpoint()
        self.state("SETPOINT")
        self.setpoint()
        self.telemetry()

    def settle(self, turns=12):
        for _ in range(turns):
            self.clock.advance(0.0)
            self.plans._disk.wait()
