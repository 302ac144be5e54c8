"""The page that controls an aircraft, and the seat at the proxy behind it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from up.commands.event_rules import INFO, Report
from up.sanitize_text import sanitize_text
from up.system.clock import Clock, Timer, cancel
from up_ground.link_status import ASK_INTERVAL_S, ControlStatus
from up_ground.web.client_session import ClientSession
from up_ground.web.messages import PageFault
from up_ground.web.proxy_lease import ProxyLease

ASK_LIMIT_S = 30.0
"""A request for control lasts this long."""
DENIED_S = 5.0
"""A denied ground may request again after it has been quiet for this time."""


class Control:
    """At most one page has control, and the seat is only held while a page wants it.

    ``report`` gets each change, ``on_change`` is called at each change.
    """

    def __init__(
        self,
        clock: Clock,
        lease: ProxyLease,
        report: Callable[[str, Report], object],
        on_change: Callable[[], object],
    ) -> None:
        self.holder: ClientSession | None = None
        self._clock = clock
        self._lease = lease
        self._report = report
        self._on_change = on_change
        self._wanting: ClientSession | None = None
        self._want_until_s = 0.0
        self._askers: dict[ClientSession, Timer] = {}
        self._ground: int | None = None
        self._ground_timer: Timer | None = None
        self._denied: dict[int, float] = {}
        self._asking: Timer | None = None

    def stop(self) -> None:
        cancel(self._asking, self._ground_timer, *self._askers.values())
        self._askers.clear()
        self.holder = self._wanting = None
        if self._lease.status is ControlStatus.OURS:
            self._lease.release()

    def request(self, page: ClientSession) -> None:
        """Give a page control, or request it from the present owner."""
        if not page.may_control:
            raise PageFault(f"this page may only watch: {page.denial}", "watch_only")
        if page in (self.holder, self._wanting):
            return
        if self.holder is None and self._wanting is None:
            self._wanting = page
            self._want_until_s = self._clock.seconds() + ASK_LIMIT_S
            self._request_lease()
        else:
            cancel(self._askers.get(page))
            self._askers[page] = self._clock.callLater(ASK_LIMIT_S, self._withdraw, page)
        self._on_change()

    def give(self, page: ClientSession, to: ClientSession | None) -> None:
        """Hand control to ``to``, or to the first page that requested it."""
        self._must_hold(page)
        if to is None and not self._askers:
            if self._ground is None:
                raise PageFault("control is not requested", "not_requested")
            self._give_to_ground()
            return
        if to is None:
            to = next(iter(self._askers))
        if not to.may_control:
            raise PageFault(f"{to.name} may only watch: {to.denial}", "watch_only")
        if to is not page:
            self._grant(to)

    def deny(self, page: ClientSession) -> None:
        """Keep control; the first page that requested it is notified."""
        self._must_hold(page)
        if self._askers:
            asker = next(iter(self._askers))
            cancel(self._askers.pop(asker))
            asker.fault(f"{page.name} keeps control", "denied")
        elif self._ground is not None:
            self._denied[self._ground] = self._clock.seconds()
            self._clear_ground_request()
        else:
            raise PageFault("control is not requested", "not_requested")
        self._on_change()

    def release(self, page: ClientSession) -> None:
        if page is self.holder:
            self._free()
        elif page is self._wanting:
            self._stop_wanting()
        elif page in self._askers:
            cancel(self._askers.pop(page))
        else:
            raise PageFault("this page has no control to release", "no_control")
        self._on_change()

    def on_away(self, page: ClientSession) -> None:
        """Stop requesting for a page whose link was lost; its control is kept for it."""
        if page in self._askers:
            cancel(self._askers.pop(page))
            self._on_change()

    def on_gone(self, page: ClientSession) -> None:
        if page in (self.holder, self._wanting) or page in self._askers:
            self.release(page)

    def on_lease(self) -> None:
        """Handle a change of the link: the seat may be granted, lost or requested."""
        status = self._lease.status
        if self._wanting is not None:
            if status is ControlStatus.OURS:
                self._grant(self._wanting)
        elif status is ControlStatus.OURS and self.holder is None:
            # Granted too late, or by its token: no page here wants it now.
            self._lease.release()
        elif self.holder is not None and status is ControlStatus.HELD:
            self._notify(
                "control_lost",
                f"ground {self._lease.holder} commands, {self.holder.name} has lost control",
            )
            self.holder = None
            self._clear_ground_request()
        elif self.holder is not None and status is not ControlStatus.OURS:
            self._request_lease()
        self._poll_ground_request()

    def describe(self, page: ClientSession) -> dict[str, Any]:
        holder, holder_name = "unknown", ""
        status = self._lease.status
        if self.holder is not None:
            holder, holder_name = "you" if page is self.holder else "page", self.holder.name
        elif status is ControlStatus.HELD:
            holder, holder_name = "ground", f"ground {self._lease.holder}"
        elif status in (ControlStatus.FREE, ControlStatus.OURS):
            holder = "nobody"
        asker = self._wanting or next(iter(self._askers), None)
        asked_by: dict[str, Any] | None = None
        if asker is not None:
            asked_by = {"page": asker.number, "name": asker.name}
        elif self._ground is not None and self.holder is not None:
            asked_by = {"page": None, "name": f"ground {self._ground}"}
        return {
            "holder": holder,
            "holder_name": holder_name,
            "asked_by": asked_by,
            "asks_you": asked_by is not None and page is self.holder,
        }

    def _request_lease(self) -> None:
        """Request the seat until it is granted or the request times out."""
        cancel(self._asking)
        status = self._lease.status
        if status is ControlStatus.OURS:
            if self._wanting is not None:
                self._grant(self._wanting)
            return
        if self._wanting is not None and self._clock.seconds() >= self._want_until_s:
            page = self._wanting
            self._stop_wanting()
            page.fault(f"{self._who(status)} within {ASK_LIMIT_S:g} s", "request_timeout")
            self._on_change()
            return
        if self._wanting is None and self.holder is None:
            return
        is_free = status is ControlStatus.FREE
        if is_free or (self._wanting is not None and status is not ControlStatus.UNKNOWN):
            self._lease.request()
        self._asking = self._clock.callLater(ASK_INTERVAL_S, self._request_lease)

    def _who(self, status: ControlStatus) -> str:
        if status is ControlStatus.HELD:
            return f"ground {self._lease.holder} has not given the seat"
        if status is ControlStatus.UNKNOWN:
            return "there was no link"
        return "the proxy has not given the seat"

    def _grant(self, page: ClientSession) -> None:
        cancel(self._asking)
        cancel(self._askers.pop(page, None))
        self._wanting = None
        self.holder = page
        self._notify("control_granted", f"{page.name} has control")
        self._on_change()

    def _free(self) -> None:
        holder, self.holder = self.holder, None
        cancel(self._asking)
        if self._askers:
            self._grant(next(iter(self._askers)))
        elif self._ground is not None:
            self._give_to_ground()
        else:
            self._lease.release()
            if holder is not None:
                self._notify("control_released", f"{holder.name} has released control")

    def _give_to_ground(self) -> None:
        ground = self._ground
        self.holder = None
        self._clear_ground_request()
        if ground is not None:
            self._lease.give(ground)
            self._notify("control_given", f"control was given to ground {ground}")
        self._on_change()

    def _stop_wanting(self) -> None:
        self._wanting = None
        cancel(self._asking)
        if self._askers:
            self._request_next()
        elif self._lease.status is ControlStatus.OURS:
            self._lease.release()

    def _request_next(self) -> None:
        page = next(iter(self._askers))
        cancel(self._askers.pop(page))
        self.request(page)

    def _withdraw(self, page: ClientSession) -> None:
        self._askers.pop(page, None)
        page.fault(f"control was not given within {ASK_LIMIT_S:g} s", "request_timeout")
        self._on_change()

    def _poll_ground_request(self) -> None:
        ground = self._lease.pop_request()
        if ground is None:
            return
        now_s = self._clock.seconds()
        if now_s - self._denied.get(ground, -DENIED_S) < DENIED_S:
            self._denied[ground] = now_s
            return
        self._denied.clear()
        self._ground = ground
        cancel(self._ground_timer)
        self._ground_timer = self._clock.callLater(ASK_LIMIT_S, self._clear_ground_request)

    def _clear_ground_request(self) -> None:
        self._ground = None
        cancel(self._ground_timer)
        self._on_change()

    def _notify(self, code: str, text: str) -> None:
        self._report("command", Report(INFO, code, sanitize_text(text, 300)))

    def _must_hold(self, page: ClientSession) -> None:
        if page is not self.holder:
            raise PageFault("this page has no control to give", "no_control")
