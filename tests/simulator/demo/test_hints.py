from up_simulator.demo.hints import log_hints, recordings


def test_the_log_of_an_earlier_flight_is_not_suggested(tmp_path):
    assert "log report" not in "".join(log_hints(tmp_path, set()))
    (tmp_path / "0001-20260814T093000Z-kite.mcap").touch()
    earlier = recordings(tmp_path)
    assert "log report" not in "".join(log_hints(tmp_path, earlier))
    (tmp_path / "0002-20260814T093000Z-kite.mcap").touch()
    assert "log report last" in log_hints(tmp_path, earlier)[0]
