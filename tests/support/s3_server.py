"""A real S3 service, SeaweedFS, on the loopback."""

import json
import shutil
import signal
import subprocess
import sysconfig
from contextlib import contextmanager
from pathlib import Path

import boto3
import pytest
from botocore.exceptions import BotoCoreError, ClientError

from tests.support.nats_servers import free_ports
from tests.support.tools import unavailable
from tests.support.waiting import DEADLINE_S, until

KEY, SECRET, BUCKET = "raspilot", "secret-of-the-tests", "flights"
STARTS = 3
"""Another program may take a port before it is bound."""
_PORTS = ("master.port", "master.port.grpc", "volume.port", "volume.port.grpc", "filer.port",
          "filer.port.grpc", "s3.port", "s3.port.grpc")  # fmt: skip


class S3Server:
    """One server with an empty bucket, as a context; it ends with it."""

    def __init__(self, folder):
        self._program = shutil.which("weed", path=sysconfig.get_path("scripts"))
        self._program = self._program or shutil.which("weed")
        if self._program is None:
            unavailable("weed is not installed (SeaweedFS 4; its wheel is for x86_64 only)")
        self._folder = Path(folder)
        self._log = self._folder / "weed.log"
        identity = {
            "name": "test",
            "credentials": [{"accessKey": KEY, "secretKey": SECRET}],
            "actions": ["Admin", "Read", "Write", "List"],
        }
        (self._folder / "s3.json").write_text(json.dumps({"identities": [identity]}))
        self._process = None

    def __enter__(self):
        for _ in range(STARTS):
            self._start()
            until(lambda: self._is_serving() or self._process.poll(), self._log.read_text)
            if self._process.poll() is None:
                return self
        pytest.fail(f"it does not start: {self._log.read_text()[-2000:]}")

    def _start(self):
        """Start it at ports that were free a moment ago."""
        ports = dict(zip(_PORTS, free_ports(len(_PORTS)), strict=True))
        self.endpoint = f"http://127.0.0.1:{ports['s3.port']}"
        self.pool = {"s3_bucket": BUCKET, "s3_endpoint": self.endpoint}
        more = {**ports, "dir": self._folder, "ip": "127.0.0.1", "ip.bind": "127.0.0.1",
                "s3.config": self._folder / "s3.json", "s3.port.iceberg": 0, "s3.port.lance": 0,
                "volume.max": 8, "master.volumeSizeLimitMB": 64}  # fmt: skip
        options = [f"-{name}={value}" for name, value in more.items()]
        with self._log.open("wb") as log:
            command = [self._program, "server", "-s3", *options]
            self._process = subprocess.Popen(command, stdout=log, stderr=log)

    def __exit__(self, *_):
        self._process.kill()
        self._process.wait(DEADLINE_S)

    @contextmanager
    def paused(self):
        """Stop it as SIGSTOP does, and let it go on at the end."""
        self._process.send_signal(signal.SIGSTOP)
        try:
            yield
        finally:
            self._process.send_signal(signal.SIGCONT)

    def unread_bytes(self):
        """Return what clients have sent to it and it has not read."""
        port = f":{int(self.endpoint.rpartition(':')[2]):04X}"
        lines = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
        queues = [words[4] for words in lines if words[1].endswith(port)]
        return sum(int(queue.partition(":")[2], 16) for queue in queues)

    def client(self):
        return boto3.client(
            "s3",
            endpoint_url=self.endpoint,
            region_name="us-east-1",
            aws_access_key_id=KEY,
            aws_secret_access_key=SECRET,
        )

    def credentials(self, path):
        """Write the file of `s3_credentials`."""
        path.write_text(f"{KEY}:{SECRET}\n")
        path.chmod(0o600)

    def _is_serving(self):
        """The first object is taken when the volumes are there."""
        client = self.client()
        try:
            client.create_bucket(Bucket=BUCKET)
            client.put_object(Bucket=BUCKET, Key="first", Body=b"")
        except (BotoCoreError, ClientError):
            return False
        return True
