"""A CRSF receiver, `python main.py` and the compiled firmware, on real ptys."""

from contextlib import closing

from tests.cogs.arduino_cog.flying import firmware, flying
from tests.cogs.crsf_cog.rig import channels_frame, statistics_frame
from up_rig.pty_line import PtyLine


def test_the_switch_decides_over_the_channel_of_the_receiver(tmp_path):
    path = tmp_path / "crsf"
    crsf = f"port: {path}\nmode_channel: 6\nmodes: [RATE, FBW]\n"
    with closing(PtyLine(path)) as line, flying(firmware(), tmp_path, crsf=crsf) as both:
        board, ground = both[0], both[1].ground
        board.move(aux1=1000)
        ground.sees("the switch", flight_mode="ACRO")

        def swing(condition):
            """Let the pilot move channel 6 to and fro; a busy machine only makes it longer."""

            def is_so():
                is_low = (ground.at("system.clock_ms") or 0) // 600 % 2
                line.write(statistics_frame(100) + channels_frame({6: 988 if is_low else 2012}))
                return condition()

            board.wait(is_so, "the effect of channel 6")

        swing(lambda: ground.at("counters.crsf.refused_not_at_auto"))
        assert ground.at("flight_mode") == "ACRO" and not ground.at("counters.crsf.selected")
        board.move(aux1=2000)
        ground.sees("the switch", arduino__switch="high")
        swing(lambda: ground.at("flight_mode") == "RATE")
