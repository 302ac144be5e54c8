"""Whether the Host header of an HTTP request names this machine."""

import re
from collections.abc import Collection
from ipaddress import ip_address

_AUTHORITY = re.compile(
    r"(?:\[([0-9A-Fa-f:.]{2,45}(?:%[A-Za-z0-9._-]{1,40})?)\]|([A-Za-z0-9._-]{1,255}))"
    r"(?::[0-9]{1,5})?",
    re.ASCII,
)


def names_this_machine(host: str | None, names: Collection[str]) -> bool:
    """Return whether a Host header is a literal address or one of `names` (in lower case).

    Any other name may resolve to this machine by DNS rebinding: another site's page could then read
    the answer.
    """
    match = _AUTHORITY.fullmatch(host or "")
    if match is None:
        return False
    address, name = match[1], match[2]
    if address is not None:
        return _is_address(address.partition("%")[0])
    return _is_address(name) or name.casefold().rstrip(".") in names


def _is_address(text: str) -> bool:
    try:
        ip_address(text)
    except ValueError:
        return False
    return True
