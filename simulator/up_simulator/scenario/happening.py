"""Makes the events of a scenario happen."""

from __future__ import annotations

from typing import cast

from up_simulator.aircraft.airframe_file import ImuConfig
from up_simulator.firmware.board import Channel, ImuFault, ResetCause
from up_simulator.scenario.companions import Companions
from up_simulator.scenario.event import Event
from up_simulator.scenario.line_board import LineBoard
from up_simulator.scenario.scenario import Scenario


def happen(
    event: Event, board: LineBoard, companions: Companions, imu: ImuConfig, scenario: Scenario
) -> None:
    """Carry out one event now: at the board and its wires, or at the crew.

    ``imu`` is the mounting of the airframe's IMU. Raises CrewError.
    """
    match event.kinds[0]:
        case "mark":
            pass
        case "imu":
            board.imu.set_fault(cast(ImuFault, event.imu))
        case "imu_errors":
            assert event.imu_errors is not None
            board.imu.errors = event.imu_errors.errors(imu, scenario.seed)
        case "receiver":
            if event.receiver == "failsafe":
                board.lose_radio(scenario.receiver.failsafe_throttle_us)
            else:
                board.set_receiver(event.receiver == "back")
                board.find_radio()
        case "channel_lost":
            board.set_channel(cast(Channel, event.channel_lost), False)
        case "channel_back":
            board.set_channel(cast(Channel, event.channel_back), True)
        case "reset":
            board.reset(cast(ResetCause, event.reset))
        case "serial_noise":
            assert event.serial_noise is not None
            board.wires.set_noise(event.serial_noise, board.now_s)
        case "serial":
            board.wires.is_plugged = event.serial == "back"
            companions.carry_out(event)
        case _:
            companions.carry_out(event)
