package org.raspilot.up.ground;

import org.raspilot.up.wire.ControlLine;
import org.raspilot.up.wire.Hello;
import org.raspilot.up.wire.HelloAnswer;
import org.raspilot.up.wire.ProxyRole;

/**
 * The seat that this ground requests, the token to resume it, and the proxy's messages about both.
 * Source: docs/protocols.md 9.
 */
final class ControlLease {
    private final GroundSettings settings;
    private final TokenStore tokens;
    private final LinkStatus facts;
    private ProxyRole wanted;
    private String token;

    /** Writes its results into {@code facts}. */
    ControlLease(GroundSettings settings, TokenStore tokens, LinkStatus facts) {
        this.settings = settings;
        this.tokens = tokens;
        this.facts = facts;
    }

    /** Resets to the seat of the settings and the stored token. */
    void reset() {
        wanted = settings.role;
        token = null;
        if (wanted == ProxyRole.COMMAND && !settings.isDirect) {
            final String stored = tokens.load(settings.tokenKey());
            token = Hello.isToken(stored) ? stored : null;
        }
    }

    void setWanted(ProxyRole seat) {
        wanted = seat;
    }

    /** Discards the token: the next hello is that of a new ground. */
    void dropToken() {
        token = null;
        tokens.remove(settings.tokenKey());
    }

    byte[] hello() {
        return Hello.ofGround(settings.aircraft, wanted, wanted == ProxyRole.COMMAND
                ? token : null);
    }

    void onAccepted(HelloAnswer answer) {
        facts.role = answer.role;
        if (answer.role == ProxyRole.COMMAND) {
            storeToken(answer.token);
        }
    }

    void onControl(ControlLine said) {
        switch (said.kind) {
            case SEAT_COMMAND:
                setRole(ProxyRole.COMMAND);
                storeToken(said.token);
                break;
            case SEAT_LISTEN:
                setRole(ProxyRole.LISTEN);
                facts.requestedBy = null;
                dropToken();
                break;
            case SEAT_ASKED:
                facts.requestedBy = said.number;
                break;
            case SEAT_HOLDER:
                facts.owner = said.number;
                facts.isOwnerKnown = true;
                break;
            default:
                facts.isAircraftOnline = said.kind == ControlLine.Kind.AIRCRAFT_ONLINE;
        }
    }

    private void setRole(ProxyRole given) {
        facts.role = given;
        wanted = given;
        facts.isReleased = false;
    }

    private void storeToken(String given) {
        token = given;
        tokens.save(settings.tokenKey(), given);
    }
}
