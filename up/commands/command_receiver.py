"""The mediator between the outside and the bus (thesis 3.2.1, 4.1.4)."""

from collections import Counter
from collections.abc import Callable
from typing import Any

from twisted.internet.defer import Deferred, TimeoutError
from twisted.logger import Logger
from twisted.python.failure import Failure

from up.cleanup import add_cleanup
from up.commands.beacon import Beacons
from up.commands.command import BaseCommand, InvalidCommandError
from up.commands.command_executor import CommandExecutor
from up.commands.command_link import CommandLink
from up.commands.origin import INTERNAL, Origin
from up.commands.outcome_publisher import OutcomePublisher
from up.commands.refusal import Code, CommandRefusedError, UnhandledCommandError
from up.protocols.general_message import GeneralMessage, MalformedMessage

OUTCOME_LIMIT_S = 2.0
_FAILED = "execution failed; see the log of the aircraft"
Route = Callable[[BaseCommand, CommandLink, str | None], "Deferred[None] | None"]


class CommandReceiver:
    """Decodes, validates and authorizes external messages, and answers those with an id.

    Default deny: a Command never reaches the bus if it is unknown to the executor's registry,
    violates the bounds of a field, exceeds the role of its link or echoes an old beacon.
    """

    log = Logger()

    def __init__(self, executor: CommandExecutor, beacons: Beacons, clock: Any) -> None:
        self.counters: Counter[str] = Counter()
        self._executor = executor
        self._beacons = beacons
        self._clock = clock
        self._routes: dict[str, Route] = {}
        self.outcomes = OutcomePublisher(executor, clock)

    def execute_command(self, command: BaseCommand, origin: Origin = INTERNAL) -> None:
        """Publish a Command from a module of this program (the prototype's name)."""
        self._executor.execute_command(command, origin)

    def register_route(self, name: str, route: Route) -> None:
        """Set the module that forwards Commands with this ``ROUTE``; one module per route."""
        if name in self._routes:
            raise ValueError(f"the route {name!r} is taken")
        self._routes[name] = route
        add_cleanup(lambda: self._routes.pop(name, None))

    def receive(self, message: GeneralMessage, link: CommandLink) -> None:
        """Handle one message from a link: publish it, route it, or refuse it.

        An exception in a cog's Command or route costs this message, not the link.
        """
        self.counters["received"] += 1
        try:
            self._receive(message, link)
        except Exception:  # noqa: BLE001 - an exception must not end the link
            self._executor.limited.log(
                self.log.failure,
                "{name} from {link} failed",
                key=(link.name, message.name),
                failure=Failure(),
                name=message.name,
                link=link.name,
            )
            self.refuse(link, message, Code.FAILED, _FAILED)

    def _receive(self, message: GeneralMessage, link: CommandLink) -> None:
        cls = self._executor.registry.get(message.name)
        if link.is_repeated(message):
            self.counters["repeated"] += 1
            return
        if cls is None:
            self.refuse(link, message, Code.UNKNOWN, f"no Command {message.name[:64]!r}")
            return
        try:
            command = cls.from_data(message.data)
        except InvalidCommandError as error:
            self.refuse(link, message, Code.INVALID, f"{cls.NAME}: {error}")
            return
        if link.origin.role.includes.isdisjoint(command.roles()):
            self.refuse(link, message, Code.FORBIDDEN, self._forbidden(command, link))
            return
        reason = None if link.policy is None else link.policy(command)
        if reason is not None:
            self.refuse(link, message, Code.FORBIDDEN, f"{command.NAME}: {reason}")
            return
        refusal = self._check_beacon(command, message, link)
        if refusal is not None:
            self.refuse(link, message, *refusal)
            return
        self._carry_out(command, message, link)

    def receive_malformed(self, malformed: MalformedMessage, link: CommandLink) -> None:
        """Count a line that is not a General Message; nack it if its id can be read."""
        self.counters["malformed"] += 1
        reason = f"dropped a malformed message: {malformed.reason}"
        self._log_refusal(link, (Code.MALFORMED, ""), reason)
        link.nack(malformed.id, Code.MALFORMED, malformed.reason)
        if malformed.id is not None:
            code = Code.MALFORMED.value
            self.outcomes.report(link.origin, "", malformed.id, code, malformed.reason)

    def _check_beacon(
        self, command: BaseCommand, message: GeneralMessage, link: CommandLink
    ) -> tuple[Code, str] | None:
        if message.beacon is None:
            # Without one a relay could hold a protected Command back for hours.
            if command.NEEDS_BEACON or link.is_protected:
                return Code.NO_BEACON, f"{command.NAME} must echo the newest telemetry's beacon"
            return None
        if not self._beacons.was_sent(message.beacon):
            return Code.UNKNOWN_BEACON, "no frame since the aircraft's start had the echoed beacon"
        if not self._beacons.is_fresh(message.beacon):
            return Code.STALE, f"the echoed beacon is older than {self._beacons.limit_s:g} s"
        return None

    def _carry_out(self, command: BaseCommand, message: GeneralMessage, link: CommandLink) -> None:
        if command.ROUTE:
            done = self._route(command, message, link)
        elif message.id is None:
            self._executor.execute_command(command, link.origin)
            if link.is_protected:
                self._report(link, message, self._age_ms(message))
            return
        else:
            done = self._executor.execute_and_wait(command, link.origin)
        if done is None:
            return
        done.addTimeout(OUTCOME_LIMIT_S, self._clock)
        age_ms = self._age_ms(message)
        done.addCallbacks(
            self._carried_out, self._refused_later, (message, link, age_ms), {}, (message, link)
        )

    def _carried_out(
        self, _: object, message: GeneralMessage, link: CommandLink, age_ms: int | None
    ) -> None:
        link.ack(message.id)
        if message.id is not None or link.is_protected:
            self._report(link, message, age_ms)

    def _report(
        self, link: CommandLink, message: GeneralMessage, age_ms: int | None, *refusal: str
    ) -> None:
        self.outcomes.report(link.origin, message.name, message.id, *refusal, age_ms=age_ms)

    def _age_ms(self, message: GeneralMessage) -> int | None:
        """Return the age of the telemetry that the sender had seen."""
        age_s = None if message.beacon is None else self._beacons.age_s(message.beacon)
        return None if age_s is None else round(age_s * 1000)

    def _route(
        self, command: BaseCommand, message: GeneralMessage, link: CommandLink
    ) -> Deferred[None] | None:
        route = self._routes.get(command.ROUTE)
        if route is None:
            self.refuse(
                link, message, Code.UNAVAILABLE, f"no module forwards Commands to {command.ROUTE}"
            )
            return None
        try:
            return route(command, link, message.id)
        except CommandRefusedError as error:
            self.refuse(link, message, error.code, error.reason, error.detail)
            return None

    def _refused_later(self, failure: Failure, message: GeneralMessage, link: CommandLink) -> None:
        error = failure.value
        if isinstance(error, CommandRefusedError):
            self.refuse(link, message, error.code, error.reason, error.detail)
        elif isinstance(error, UnhandledCommandError):
            self.refuse(link, message, Code.UNAVAILABLE, f"no module handles {message.name}")
        elif isinstance(error, TimeoutError):
            self.refuse(link, message, Code.TIMEOUT, "the module that executes it did not answer")
        else:
            self.refuse(link, message, Code.FAILED, _FAILED)

    def _forbidden(self, command: BaseCommand, link: CommandLink) -> str:
        wanted = " or ".join(sorted(role.value for role in command.roles())) or "nobody"
        reason = f"{command.NAME} is for {wanted}; this link is {link.origin.role.value}"
        if command.roles() and link.role_key:
            reason += f" ({link.role_key})"
        return reason

    def refuse(
        self, link: CommandLink, message: GeneralMessage, code: Code, reason: str, detail: str = ""
    ) -> None:
        """Refuse a message: count, log, nack and report it."""
        self.counters[code.value] += 1
        # All unknown names share one key, so that a peer cannot add keys.
        name = "" if code is Code.UNKNOWN else message.name
        self._log_refusal(link, (code, name), f"refused: {reason}")
        link.nack(message.id, code, reason, detail)
        self._report(link, message, self._age_ms(message), code.value, reason, detail)

    def _log_refusal(self, link: CommandLink, key: tuple[Code, str], text: str) -> None:
        limited = self._executor.limited
        limited.log(self.log.warn, "{link} {text}", key=(link.name, key), link=link.name, text=text)
