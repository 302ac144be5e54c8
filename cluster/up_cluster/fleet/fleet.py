"""A client of all members of a cluster."""

from __future__ import annotations

import json
import secrets
from collections import defaultdict
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

from twisted.internet.defer import Deferred, TimeoutError
from twisted.internet.task import deferLater
from twisted.python.failure import Failure

from up.errors import UserError
from up_cluster.config import FleetConfig
from up_cluster.errors import RefusedError, UnavailableError
from up_cluster.jetstream import NOT_ENABLED, STREAM_NOT_FOUND
from up_cluster.key_value import Entry
from up_cluster.lease import parse_record
from up_cluster.membership import LEASES, Membership, aircraft_of, parse
from up_cluster.nats_protocol import Message

CONNECT_LIMIT_S = 10.0
POLL_S = 0.25
ANSWER_S = 5.0
READ_S = 12.0
"""For all entries: time to repeat the request if NATS chooses a dead server to send them."""
KINDS = {"aircraft": "proxy", "instance": "runner"}
"""The keys of the leases, and the kind of member that holds them."""

Rows = list[dict[str, Any]]
Entries = defaultdict[str, dict[str, Entry]]
"""The entries of a tenant by their kind and aircraft."""


class FleetError(UserError):
    """A member refused a request, or did not answer."""


def report_in(payload: bytes) -> dict[str, Any] | None:
    """Return a member's report; None: it is malformed, or of another version."""
    try:
        report = parse(payload)
    except ValueError:
        return None
    names = [report.get(each) for each in ("id", "kind", "host")]
    rows, is_draining = report.get("aircraft"), report.get("is_draining")
    if not (all(isinstance(each, str) for each in names) and isinstance(is_draining, bool)):
        return None
    guests = report.get("guests", [])
    if not (isinstance(rows, list) and isinstance(guests, list)):
        return None
    is_row = (
        isinstance(row, dict) and {"aircraft", "state"} <= row.keys() for row in rows + guests
    )
    return report if all(is_row) else None


def numbers_in(report: dict[str, Any], key: str) -> dict[str, float]:
    """Return the numbers by kind in a report; a member of another version may have none."""
    found = report.get(key)
    pairs = found.items() if isinstance(found, dict) else ()
    return {kind: value for kind, value in pairs if isinstance(value, int | float)}


def leases_in(entries: Entries) -> Rows:
    """Return who holds which aircraft; of a free one, with `is_free`, just its control is kept."""
    rows: Rows = []
    for kind in KINDS:
        for name, entry in entries[kind].items():
            record = parse_record(entry)
            if record is not None:
                row = {"kind": kind, "aircraft": name, "id": record.node}
                free = {"is_free": True} if record.data.get("air", "") is None else {}
                rows.append({**row, "host": str(record.data.get("host", "")), **free})
    return rows


def occupied(leases: Rows) -> Rows:
    """Return the leases whose members should answer."""
    return [row for row in leases if "is_free" not in row]


class Fleet:
    """Sends requests to the members; every method reports the result, not the request.

    The constructor raises ClusterError, TLSError.
    """

    def __init__(self, reactor: Any, config: FleetConfig, folder: Path) -> None:
        self._reactor = reactor
        self._config = config
        self._member = Membership(reactor, config, folder, program="up-fleet")
        self._client = self._member.client

    def run(self, work: Callable[[], Awaitable[Any]]) -> Any:
        """Connect, run until the work is done, and return its result. Raises FleetError."""
        result: list[Any] = []

        async def steps() -> Any:
            try:
                await self._connect()
                await self._check()
                return await work()
            except (UnavailableError, RefusedError) as error:
                raise FleetError(str(error), "no_answer") from None
            finally:
                await self._client.stop()

        def finish(outcome: Any) -> None:
            result.append(outcome)
            self._reactor.stop()

        self._reactor.callWhenRunning(lambda: Deferred.fromCoroutine(steps()).addBoth(finish))
        self._reactor.run()
        if not result:
            raise KeyboardInterrupt
        if isinstance(result[0], Failure):
            result[0].raiseException()
        return result[0]

    async def _connect(self) -> None:
        """Raise FleetError without a connection: at once if each server refuses it."""
        client, failures = self._client, self._client.failures
        client.start()

        def is_decided() -> bool:
            refused = [code == "nats_refused" or code.startswith("tls_") for code, _ in failures]
            return client.is_connected or (len(refused) == failures.maxlen and all(refused))

        await self._wait_for(is_decided, CONNECT_LIMIT_S)
        if not client.is_connected:
            code, reason = failures[-1] if failures else ("no_connection", "no answer")
            text = f"no connection to NATS at {self._config.servers}: {reason}"
            raise FleetError(f"{text} (fleet.yml: servers, credentials, tls)", code)

    async def _check(self) -> None:
        """Raise FleetError for a NATS that no proxy or runner of a cluster uses."""
        where = f"NATS at {self._config.servers}"
        try:
            await self._member.bucket.check()
        except (UnavailableError, RefusedError) as error:
            if error.code in ("no_responders", *NOT_ENABLED):
                text = (
                    f"{where} has no JetStream for this account (nats.conf: jetstream, accounts; "
                    "fleet.yml: credentials)"
                )
                raise FleetError(text, "no_jetstream") from None
            if error.code == STREAM_NOT_FOUND:
                text = (
                    f"{where} has no bucket {LEASES}: no proxy or runner has used it yet, or they "
                    "use another account (fleet.yml: servers, credentials)"
                )
                raise FleetError(text, "no_bucket") from None
            raise

    async def overview(self, wait_s: float) -> dict[str, Any]:
        """Return the members that answered in time, and the entries of those that did not."""
        entries = await self._entries()
        leases = leases_in(entries)
        members = await self._reports(wait_s, leases)
        known = {each["id"] for each in members}
        held = {row["aircraft"] for row in leases if row["kind"] == "instance"}
        wanted = entries["wanted"].keys()
        return {
            "members": members,
            "lost": [row for row in occupied(leases) if row["id"] not in known],
            "orphans": sorted(wanted - held),
            "asleep": sorted(entries["asleep"].keys() - wanted),
        }

    async def usage(self, wait_s: float) -> dict[str, Any]:
        """Return the overview, and the tenant's usage and quotas.

        Each member knows the whole tenant, a new one a part of the hour: the highest counts. Of
        different quotas the lowest is the one that refuses.
        """
        found = await self.overview(wait_s)
        usage: dict[str, float] = {}
        quota: dict[str, float] = {}
        for member in found["members"]:
            for kind, count in numbers_in(member, "usage").items():
                usage[kind] = max(count, usage.get(kind, count))
            for kind, limit in numbers_in(member, "quota").items():
                quota[kind] = min(limit, quota.get(kind, limit))
        return {**found, "tenant": {"name": self._config.tenant, "usage": usage, "quota": quota}}

    async def where(self, aircraft: str, wait_s: float) -> dict[str, Any]:
        """Return where an aircraft is, or is wanted. Raises FleetError if it is nowhere."""
        entries = await self._entries()
        leases = [each for each in leases_in(entries) if each["aircraft"] == aircraft]
        members = {each["id"]: each for each in await self._reports(wait_s, leases)}
        places = []
        for lease in leases:
            member = members.get(lease["id"], {})
            rows = (each for each in member.get("aircraft", ()) if each["aircraft"] == aircraft)
            row = next(rows, None)
            if row is None and (member or "is_free" in lease):
                continue  # it has left
            row = row or {"state": "no answer"}
            place = {"id": lease["id"], "host": member.get("host", lease["host"])}
            places.append({**row, "kind": KINDS[lease["kind"]], **place})
        if all(each["kind"] != "runner" for each in places):
            state = next((key for key in ("wanted", "asleep") if aircraft in entries[key]), "")
            if state:
                places.append({"kind": "runner", "id": "", "host": "", "state": state})
        if not places:
            raise FleetError(f"no member holds {aircraft}", "unknown_aircraft", aircraft=aircraft)
        return {"aircraft": aircraft, "places": places}

    async def drain(self, member: str, wait_s: float) -> dict[str, Any]:
        """Drain a member and wait until it holds nothing. Raises FleetError."""
        left = (await self._ask(member, {"action": "drain"}))["leaving"]

        async def is_empty() -> bool:
            return not (await self._ask(member, {"action": "report"}))["aircraft"]

        end_s = self._reactor.seconds() + wait_s
        while not await is_empty():
            if self._reactor.seconds() > end_s:
                text = f"{member} drains, but still has aircraft after {wait_s:g} s"
                raise FleetError(text, "not_drained", member=member)
            await deferLater(self._reactor, POLL_S)
        return {"id": member, "left": left}

    async def kick(self, aircraft: str, kind: str) -> dict[str, Any]:
        """Disconnect an aircraft, or stop its instance. Raises FleetError."""
        entries = await self._entries()
        for lease in leases_in(entries):
            if (lease["aircraft"], lease["kind"]) == (aircraft, kind):
                await self._ask(lease["id"], {"action": "kick", "aircraft": aircraft})
                done = "stopped" if kind == "instance" else "disconnected"
                return {"aircraft": aircraft, "done": done, "id": lease["id"]}
        for key in ("wanted", "asleep") if kind == "instance" else ():
            if (entry := entries[key].get(aircraft)) is not None:
                await self._member.bucket.purge(entry.key, expected=entry.revision)
                return {"aircraft": aircraft, "done": "not_wanted", "id": ""}
        raise FleetError(f"no member holds {aircraft}", "unknown_aircraft", aircraft=aircraft)

    async def _ask(self, member: str, request: dict[str, Any]) -> dict[str, Any]:
        try:
            answer = await self._member.ask(member, request, ANSWER_S)
        except UnavailableError as error:
            text = f"the member {member} does not answer ({error.code})"
            raise FleetError(text, "no_answer", member=member) from None
        if answer.get("code"):
            text = f"the member {member} refused: {answer['code']}"
            raise FleetError(text, str(answer["code"]), member=member)
        return answer

    async def _reports(self, wait_s: float, leases: Rows) -> Rows:
        """Return the answers of `wait_s`; of members that hold aircraft those of ANSWER_S."""
        found: Rows = []
        inbox = f"_INBOX.{secrets.token_hex(8)}"

        def on_report(message: Message) -> None:
            report = report_in(message.payload)
            if report is not None:
                found.append(report)

        sid = self._client.subscribe(inbox, on_report)
        request = json.dumps({"action": "report"}).encode()
        self._client.publish(self._member.subject("members"), request, reply=inbox)
        await deferLater(self._reactor, wait_s)
        holders = {each["id"] for each in occupied(leases)}
        await self._wait_for(lambda: holders <= {each["id"] for each in found}, ANSWER_S)
        self._client.unsubscribe(sid)
        return sorted(found, key=lambda each: (each["kind"], each["host"], each["id"]))

    async def _entries(self) -> Entries:
        found: Entries = defaultdict(dict)
        done: Deferred[None] = Deferred()

        def on_entry(entry: Entry) -> None:
            if not entry.is_deleted:
                found[entry.key.partition(".")[0]][aircraft_of(entry.key)] = entry

        def on_current(is_current: bool) -> None:
            if is_current and not done.called:
                done.callback(None)

        pattern = self._member.key("*", "*")
        watch = self._member.bucket.watch(pattern, on_entry, on_current, self._reactor)
        done.addTimeout(READ_S, self._reactor)
        try:
            await done
        except TimeoutError:
            raise UnavailableError("timeout") from None
        finally:
            watch.stop()
        return found

    async def _wait_for(self, is_true: Callable[[], bool], limit_s: float) -> None:
        end_s = self._reactor.seconds() + limit_s
        while not is_true() and self._reactor.seconds() < end_s:
            await deferLater(self._reactor, POLL_S / 5)
