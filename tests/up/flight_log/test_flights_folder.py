from pathlib import Path

from up.flight_log.flights_folder import default_folder, folder_of


def test_where_flights_are_kept_by_default(monkeypatch):
    assert default_folder({"STATE_DIRECTORY": "/var/lib/raspilot:/b"}) == Path(
        "/var/lib/raspilot/flights"
    )
    assert default_folder({"XDG_STATE_HOME": "/x"}) == Path("/x/raspilot/flights")
    monkeypatch.setenv("HOME", "/home/pilot")
    for environ in ({}, {"XDG_STATE_HOME": "relative"}, {"STATE_DIRECTORY": ""}):
        assert default_folder(environ) == Path("/home/pilot/.local/state/raspilot/flights")
    assert folder_of("~/flown", {}) == Path("/home/pilot/flown")
    assert folder_of("", {"XDG_STATE_HOME": "/x"}) == Path("/x/raspilot/flights")
