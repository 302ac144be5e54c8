package org.raspilot.up.ground;

import org.raspilot.up.wire.ControlLine;
import org.raspilot.up.wire.Hello;
import org.raspilot.up.wire.HelloAnswer;
import org.raspilot.up.wire.Seat;

/**
 * The seat that this ground requests, the token to resume it, and the proxy's messages about both.
 * Source: docs/protocols.md 9.
 */
final class SeatClaim {
    private final GroundSettings settings;
    private final TokenStore tokens;
    private final LinkFacts facts;
    private Seat wanted;
    private String token;

    /** Writes its results into {@code facts}. */
    SeatClaim(GroundSettings settings, TokenStore tokens, LinkFacts facts) {
        this.settings = settings;
        this.tokens = tokens;
        this.facts = facts;
    }

    /** Resets to the seat of the settings and the stored token. */
    void begin() {
        wanted = settings.seat;
        token = null;
        if (wanted == Seat.COMMAND && !settings.isDirect) {
            final String stored = tokens.load(settings.tokenKey());
            token = Hello.isToken(stored) ? stored : null;
        }
    }

    /** Requests this seat from now on. */
    void want(Seat seat) {
        wanted = seat;
    }

    /** Discards the token: the next hello is that of a new ground. */
    void dropToken() {
        token = null;
        tokens.forget(settings.tokenKey());
    }

    /** Returns the hello that requests the seat. */
    Hello hello() {
        return Hello.ofGround(settings.aircraft, wanted, wanted == Seat.COMMAND ? token : null);
    }

    /** Takes the answer that accepts this ground. */
    void onAccepted(HelloAnswer answer) {
        facts.seat = answer.seat;
        if (answer.seat == Seat.COMMAND) {
            keep(answer.token);
        }
    }

    /** Takes a line of the proxy; returns false for one that only a ground sends. */
    boolean onControl(ControlLine said) {
        switch (said.kind) {
            case SEAT_COMMAND:
                become(Seat.COMMAND);
                keep(said.token);
                return true;
            case SEAT_LISTEN:
                become(Seat.LISTEN);
                facts.askedBy = null;
                dropToken();
                return true;
            case SEAT_ASKED:
                facts.askedBy = said.number;
                return true;
            case SEAT_HOLDER:
                facts.holder = said.number;
                facts.isHolderKnown = true;
                return true;
            case AIRCRAFT_ONLINE:
                facts.isAircraftOnline = true;
                return true;
            case AIRCRAFT_OFFLINE:
                facts.isAircraftOnline = false;
                return true;
            default:
                return false;
        }
    }

    private void become(Seat given) {
        facts.seat = given;
        wanted = given;
        facts.isLeft = false;
    }

    private void keep(String given) {
        token = given;
        tokens.save(settings.tokenKey(), given);
    }
}
