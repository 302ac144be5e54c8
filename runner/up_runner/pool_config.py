"""The section `pool:` of runner.yml."""

from __future__ import annotations

import re
from collections.abc import Iterator
from urllib.parse import urlsplit

from up.config import items, key
from up.fields import Constraint
from up.quick_dataclass import dataclass
from up_cluster.config import ClusterConfig
from up_runner.request import LABEL, MAX_LABELS

_BUCKET = re.compile(r"[a-z0-9][a-z0-9.-]{1,61}[a-z0-9]", re.ASCII)


@dataclass(frozen=True, slots=True)
class PoolConfig(ClusterConfig):
    """The NATS servers over which several runners act as one."""

    address: str = key(
        "",
        "Name or address of this host for phones: the answers name it. Required with servers.",
        max_length=255,
    )
    labels: tuple[str, ...] = items(
        Constraint(str, max_length=32),
        "What a request may require of the host: words of A-Z a-z 0-9 _ . -",
        max_length=MAX_LABELS,
    )
    quota_instances: int = key(
        0,
        "Instances of the tenant at all runners together; 0: as many as have a place.",
        minimum=0,
        maximum=1000000,
    )
    sleep_after_s: float = key(
        14400.0,
        "An instance whose phone is gone for this time, and that reports that it is not armed, "
        "sleeps until the next request for its aircraft. Only with exit on connection lost: "
        "false; otherwise it ends after the exit delay. 0: never.",
        unit="s",
        minimum=0,
        maximum=2592000,
    )
    lease_s: int = key(
        10,
        "Time to live of an instance's lease. Shorter than 10 s, every death of a NATS server "
        "restarts instances; longer, those of a dead host start later elsewhere.",
        name="lease",
        unit="s",
        minimum=3,
        maximum=60,
    )

    s3_bucket: str = key(
        "",
        "Bucket of S3, or of a service with its API, for learned files and flights. It must exist "
        "and honour conditional writes. Empty: the object store of NATS.",
        max_length=63,
    )
    s3_endpoint: str = key(
        "",
        "Address of that service, as in https://s3.example.org:9000. Empty: Amazon S3.",
        max_length=255,
    )
    s3_region: str = key("", "Region of the bucket. Empty: AWS_REGION.", max_length=32)
    s3_credentials: str = key(
        "",
        "File with KEY:SECRET for S3, mode 600, relative to this file. Empty: as the AWS programs, "
        "from the environment, ~/.aws or the role of the host.",
        max_length=4096,
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        yield from ClusterConfig.problems(self)
        if self.servers and not self.address:
            yield "address", "must name this host for phones"
        if self.s3_bucket and not _BUCKET.fullmatch(self.s3_bucket):
            yield "s3_bucket", "must be 3 to 63 of a-z 0-9 . -"
        if self.s3_endpoint and not _is_endpoint(self.s3_endpoint):
            yield "s3_endpoint", "must be as in https://s3.example.org:9000"
        for name in ("s3_endpoint", "s3_region", "s3_credentials"):
            if getattr(self, name) and not self.s3_bucket:
                yield name, "needs s3_bucket"
        for label in self.labels:
            if not LABEL.fullmatch(label):
                yield "labels", f"{label!r} is not a word of A-Z a-z 0-9 _ . -"


def _is_endpoint(text: str) -> bool:
    try:
        url = urlsplit(text)
        rest = (url.path.strip("/"), url.query, url.fragment, url.username)
        has_port = url.port is None or url.port > 0
    except ValueError:
        return False
    is_named = bool(url.hostname) and re.search(r"[A-Za-z0-9]", url.hostname or "") is not None
    return url.scheme in ("http", "https") and is_named and has_port and not any(rest)
