"""No process starts without a lease, whatever asks for it."""

import pytest

from tests.support.reactor import reactor
from up_cluster.lease import Lease, LeaseState
from up_runner.config import RunnerConfig
from up_runner.instance_config import ConfigurationRefused
from up_runner.pool.hosted import MARGIN_S
from up_runner.pool.pool import Pool
from up_runner.pool_config import PoolConfig
from up_runner.request import Request
from up_runner.runner import Runner


async def test_an_instance_without_a_lease_is_refused(short_path):
    pool = PoolConfig(servers="127.0.0.1:1", address="here")
    config = RunnerConfig(pool=pool, run_folder=str(short_path))
    runner = Runner(reactor, config, short_path)
    pool = Pool(reactor, config, short_path, runner.instances, runner.instance_host)
    response = await runner.instances.spawn(Request("glider-1"))
    assert (response.pid, response.error.code) == (None, "lease_lost")
    runner.instances.close()

    # A lease permits it until shortly before its end, and only with the number that it began with.
    until_s = reactor.seconds() + 100
    lease = Lease("instance.default.glider-1", {}, 5, 5, until_s, lambda _: None)
    pool.hosted.add(Request("glider-1"), lease)
    permit = runner.instance_host.permit
    assert permit("glider-1")["UP_DEADLINE_FILE"] == str(short_path / "glider-1" / "deadline")
    for attribute, value in (
        ("proven_until_s", reactor.seconds() + MARGIN_S),
        ("state", LeaseState.UNPROVEN),
        ("fence", 6),
    ):
        before = getattr(lease, attribute)
        setattr(lease, attribute, value)
        with pytest.raises(ConfigurationRefused):
            permit("glider-1")
        setattr(lease, attribute, before)
    permit("glider-1")
