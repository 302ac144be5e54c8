package org.raspilot.up.ground;

import org.raspilot.up.wire.Seat;

/** A snapshot of link, seat and aircraft. Immutable. */
public final class GroundStatus {
    /** The values that a {@link GroundSide} fills in before it creates a status. */
    static final class Draft {
        LinkFacts link = new LinkFacts();
        boolean isDirect;
        Double rateHz;
        boolean isSilent = true;
        boolean isLate;
        String role;
        Boolean tuneInFlight;
        Home home;
        GroundCounters counters = new GroundCounters(0, 0, 0, 0, 0, 0, 0);
    }

    private final LinkState link;
    private final long sinceMs;
    private final String reason;
    private final String rejection;
    private final boolean isDirect;
    private final Seat seat;
    private final Integer holder;
    private final SeatStanding standing;
    private final Integer askedBy;
    private final Boolean isAircraftOnline;
    private final Double roundTripMs;
    private final int failures;
    private final Double rateHz;
    private final boolean isSilent;
    private final boolean isLate;
    private final String role;
    private final Boolean tuneInFlight;
    private final Home home;
    private final GroundCounters counters;

    GroundStatus(Draft draft) {
        final LinkFacts facts = draft.link;
        link = facts.state;
        sinceMs = facts.sinceMs;
        reason = facts.reason;
        rejection = facts.rejection;
        isDirect = draft.isDirect;
        seat = facts.seat;
        holder = facts.holder;
        standing = SeatStanding.of(facts, draft.isDirect);
        askedBy = facts.askedBy;
        isAircraftOnline = facts.isAircraftOnline;
        roundTripMs = facts.roundTripMs;
        failures = facts.failures;
        rateHz = draft.rateHz;
        isSilent = draft.isSilent;
        isLate = draft.isLate;
        role = draft.role;
        tuneInFlight = draft.tuneInFlight;
        home = draft.home;
        counters = draft.counters;
    }

    /** Returns how far the link is. */
    public LinkState link() {
        return link;
    }

    /** Returns whether messages can be sent. */
    public boolean isOpen() {
        return link == LinkState.OPEN;
    }

    /** Returns since when the link is so, by the loop's clock, ms. */
    public long sinceMs() {
        return sinceMs;
    }

    /** Returns why there is no link, without a full stop; empty when it is open. */
    public String reason() {
        return reason;
    }

    /** Returns the code with which the proxy refused the hello (docs/protocols.md 9), or empty. */
    public String rejection() {
        return rejection;
    }

    /** Returns whether the link goes directly to an aircraft, without seats. */
    public boolean isDirect() {
        return isDirect;
    }

    /** Returns COMMAND or LISTEN, or null if unknown. */
    public Seat seat() {
        return seat;
    }

    /** Returns the state of the seat. */
    public SeatStanding standing() {
        return standing;
    }

    /** Returns the number of the ground that commands, or null if none or unknown. */
    public Integer holder() {
        return holder;
    }

    /** Returns the listener that requests the seat held here; null: none. */
    public Integer askedBy() {
        return askedBy;
    }

    /** Returns whether the aircraft is connected to the proxy, or null if unknown. */
    public Boolean isAircraftOnline() {
        return isAircraftOnline;
    }

    /** Returns the time to the other side and back, ms, by hello or answer; null: not known. */
    public Double roundTripMs() {
        return roundTripMs;
    }

    /** Returns how many attempts failed since the last good connection. */
    public int failures() {
        return failures;
    }

    /** Returns the frames per second, or null if too few arrive. */
    public Double rateHz() {
        return rateHz;
    }

    /** Returns whether no displayed value can be trusted to be current. */
    public boolean isSilent() {
        return isSilent;
    }

    /** Returns whether telemetry arrives, but so late that it counts as silence. */
    public boolean isLate() {
        return isLate;
    }

    /** Returns the role of grounds at this aircraft, as its telemetry reports; null: unknown. */
    public String role() {
        return role;
    }

    /** Returns whether gains may be set in flight, or null if unknown. */
    public Boolean tuneInFlight() {
        return tuneInFlight;
    }

    /** Returns the aircraft's home; null: not known. */
    public Home home() {
        return home;
    }

    /** Returns the counters. */
    public GroundCounters counters() {
        return counters;
    }

    /** Returns the state of link and aircraft for a pilot, without a full stop. */
    public String linkSentence() {
        switch (link) {
            case STOPPED:
                return "stopped";
            case CONNECTING:
                return reason.isEmpty() ? "connecting" : "connecting again: " + reason;
            case WAITING:
                return "no link: " + reason;
            default:
                return openSentence();
        }
    }

    /** Describes for a pilot who commands, without a full stop. */
    public String seatSentence() {
        switch (standing) {
            case OURS:
                if (isDirect) {
                    return "a direct link: what is sent arrives";
                }
                return askedBy == null ? "you command"
                        : "you command, ground " + askedBy + " asks for it";
            case FREE:
                return "nobody commands";
            case HELD:
                return "ground " + holder + " commands";
            case LATER:
                return "you listen";
            default:
                return "not known who commands";
        }
    }

    private String openSentence() {
        if (isAircraftOnline != null && !isAircraftOnline) {
            return "the aircraft is not connected to the proxy";
        }
        if (isLate) {
            return "telemetry comes too late";
        }
        if (isSilent) {
            return counters.frames() == 0
                    ? "connected, no telemetry yet" : "the aircraft is silent";
        }
        return "connected";
    }
}
