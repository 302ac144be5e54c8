"""The runner's page for Prometheus."""

from tests.runner.runners import can_connect
from tests.support.scrape import probe, scrape


def test_a_scrape_has_the_instances_and_the_rejections(runners):
    runner = runners(**{"metrics port": 0}).start()
    port = runner.logs("metrics_open")["port"]
    talk = runner.talk()
    assert talk.ask({"aircraft": "kite"})["spawned"]
    assert talk.ask({"aircraft": "no name"})["code"] == "malformed_request"
    read = scrape(port)
    assert read["up_runner_instances", "running"] == 1
    assert read["up_runner_instances", "stopping"] == 0
    assert read["up_runner_running", "kite"] == 1
    assert read["up_runner_connections",] == 1
    assert read["up_runner_rejected_total", "malformed"] == 1
    assert probe(port, "live") == (200, "live")
    assert probe(port, "ready") == (200, "ready")
    runner.terminate()
    assert not can_connect(port)
