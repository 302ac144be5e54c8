import re

from tests.ground.web.page import Serve
from tests.support.scrape import probe, scrape
from tests.support.waiting import until


def test_a_scrape_has_each_aircrafts_link_and_telemetry(proxy, aircraft, tmp_path):
    with Serve(tmp_path, proxy.ground_port, "--metrics", "0") as server:
        port = int(re.search(r":(\d+)/", server.event("metrics_open")["url"])[1])
        name = server.event("aircraft")["name"]
        until(lambda: scrape(port)["up_ground_frames_total", name] > 2, "telemetry")
        read = scrape(port)
        assert read["up_ground_connected", name] == 1
        assert read["up_ground_aircraft_online", name] == 1
        assert read["up_ground_control", name] == 0
        assert read["up_ground_link_connections_total", name] == 1
        assert read["up_ground_pages",] == 0
        assert probe(port, "live") == (200, "live")
        assert probe(port, "ready") == (200, "ready")
