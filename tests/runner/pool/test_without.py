"""Without `pool:` a runner loads nothing of it."""

import subprocess
import sys

PROGRAM = """
import os, sys
from pathlib import Path
from twisted.internet import reactor
from twisted.internet.defer import Deferred
from up_runner.config import RUNNER
from up_runner.runner import Runner
folder = Path(sys.argv[1])
runner = Runner(reactor, RUNNER.load(folder), folder)
runner.start()
stopped = lambda: Deferred.fromCoroutine(runner.stop())
reactor.callLater(0, lambda: stopped().addBoth(lambda _: reactor.stop()))
reactor.run()
names = ("up_cluster.", "up_runner.pool")
print(*(name for name in sys.modules if name.startswith(names)))
"""


def test_only_its_section_of_the_configuration_is_loaded(short_path):
    config = f"port: 0\ni_accept_root: true\nrun folder: {short_path / 'run'}\n"
    (short_path / "runner.yml").write_text(config)
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(short_path)], capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["up_cluster.config", "up_runner.pool_config"]
