"""Set-points as sticks of the board."""

from msp_cog.messages import pack_sticks
from msp_cog.modules.msp_board import MspBoard
from up.base_module import BaseModule
from up.commands.flight_state_command import FlightModeCommand
from up.commands.output_command import SetpointCommand
from up.commands.refusal import CommandRefusedError
from up.mode import WITH_BOARD
from up.needs import needs

CENTRE_US = 1500


class MspOutput(BaseModule):
    """Sends `up.setpoint.set` as `MSP_SET_RAW_RC`, through the curve of the board's ANGLE mode.

    A throttle that the set-point leaves to the pilot is left out, with the rudder. Nothing is sent
    unless the board's switch lets set-points act, nor in receiver failsafe: the board's own
    procedure acts. The board drops a set-point after 300 ms, whatever its lifetime.
    """

    MODES = WITH_BOARD

    board = needs(MspBoard)

    def on_init(self) -> None:
        executor = self.up.command_executor
        executor.register_command(SetpointCommand, self.on_setpoint)
        executor.register_command(FlightModeCommand, self.on_flight_mode)

    def on_setpoint(self, command: SetpointCommand) -> None:
        """Send a set-point while it may act."""
        curves, state = self.board.curves, self.board.state
        if curves is None or not state.is_auto or state.is_failsafe or command.is_failsafe:
            return
        roll, pitch = curves
        sticks = [roll.stick_us(command.roll_deg), pitch.stick_us(command.pitch_deg)]
        if command.throttle_us is not None:
            sticks += [command.throttle_us, CENTRE_US]
        self.board.send_sticks(pack_sticks(sticks))

    def on_flight_mode(self, _command: FlightModeCommand) -> None:
        """Accept every mode while the switch lets set-points act: FBW is that without any.

        Otherwise raises CommandRefusedError: the board's switch has the last word.
        """
        if not self.board.state.is_auto:
            raise CommandRefusedError(
                "the transmitter's switch is not at AUTO (MSP OVERRIDE and ANGLE of the board)",
                detail="not_at_auto",
            )
