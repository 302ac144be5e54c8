package org.raspilot.up.ground;

import org.raspilot.up.wire.ProxyRole;

/** A snapshot of link, seat and aircraft. Immutable. */
public final class GroundStatus {
    public final LinkState link;
    /** The reason for a missing link as a stable word: {@code closed silent hello_timeout ...}. */
    public final String code;

    /** The reason for a missing link, without a full stop; empty when it is open. */
    public final String reason;
    /** The code with which the proxy refused the hello (docs/protocols.md 9), or empty. */
    public final String rejection;
    /** Whether the link goes directly to an aircraft, without seats. */
    public final boolean isDirect;
    /** COMMAND or LISTEN, or null if unknown. */
    public final ProxyRole role;
    /** The number of the ground that commands, or null if none or unknown. */
    public final Integer owner;
    public final ControlStatus control;
    /** The listener that requests the seat held here; null: none. */
    public final Integer requestedBy;
    /** Whether the aircraft is connected to the proxy, or null if unknown. */
    public final Boolean isAircraftOnline;
    /** The time to the other side and back, ms, by hello or answer; null: not known. */
    public final Double roundTripMs;
    /** The frames per second, or null if too few arrive. */
    public final Double rateHz;
    /** Whether no displayed value can be trusted to be current. */
    public final boolean isSilent;
    /** Whether telemetry arrives, but so late that it counts as silence. */
    public final boolean isLate;
    /** The key's role, or that of grounds at this aircraft as telemetry reports; null: unknown. */
    public final String commandRole;
    /** Why the key's session is not open, a code of {@link KeyTexts}; empty: it is, or no key. */
    public final String keyFault;
    /** The name of this device's key for the aircraft; empty: it has none. */
    public final String keyName;
    public final boolean isTls;
    /** Whether gains may be set in flight, or null if unknown. */
    public final Boolean tuneInFlight;
    /** How many frames of telemetry came since the creation. */
    public final long frames;
    /** How many frames were sent, by the beacons' numbers, and did not come. */
    public final long lostFrames;
    /** How many lines the key did not authenticate. */
    public final long refused;
    private final long unprotected;

    GroundStatus(LinkStatus facts, boolean isDirect, TelemetryStream stream, long nowMs) {
        final Telemetry newest = stream.newest();
        link = facts.state;
        code = facts.code;
        reason = facts.reason;
        rejection = facts.rejection;
        this.isDirect = isDirect;
        role = facts.role;
        owner = facts.owner;
        control = ControlStatus.of(facts, isDirect);
        requestedBy = facts.requestedBy;
        isAircraftOnline = facts.isAircraftOnline;
        roundTripMs = facts.roundTripMs;
        rateHz = stream.rateHz(nowMs);
        isSilent = newest.age.isSilent(nowMs);
        isLate = newest.age.isLate(nowMs);
        commandRole = facts.keyRole.isEmpty() ? newest.text("ground.role") : facts.keyRole;
        keyFault = facts.keyFault();
        keyName = facts.keyName;
        isTls = facts.isTls;
        tuneInFlight = newest.flag("ground.tune_in_flight");
        frames = stream.frames();
        lostFrames = stream.lost();
        refused = facts.refused;
        unprotected = facts.unprotected;
    }

    public boolean isOpen() {
        return link == LinkState.OPEN;
    }

    /** Returns the state of link and aircraft for a pilot, without a full stop. */
    public String linkText() {
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

    /** Returns how the link is protected, with the key's name and role, without a full stop. */
    public String securityText() {
        if (keyName.isEmpty()) {
            return isTls ? "TLS, no key" : "plain link";
        }
        final String key = keyFault.isEmpty() ? "end to end: " + keyName + " (" + commandRole + ")"
                : "key " + keyName + ": " + KeyTexts.fault(keyFault);
        return isTls ? "TLS, " + key : key;
    }

    /** Describes the owner of control for a pilot, without a full stop. */
    public String controlText() {
        switch (control) {
            case OURS:
                if (isDirect) {
                    return "a direct link: Commands are always sent";
                }
                return requestedBy == null ? "you command"
                        : "you command, ground " + requestedBy + " asks for it";
            case FREE:
                return "control is free";
            case HELD:
                return "ground " + owner + " commands";
            case LATER:
                return "you listen";
            default:
                return "owner of control unknown";
        }
    }

    /** Returns the event that names why no current telemetry arrives. */
    String silenceCode() {
        if (!isOpen()) {
            return "no_link";
        }
        if (Boolean.FALSE.equals(isAircraftOnline)) {
            return "aircraft_offline";
        }
        return isLate ? "late" : "silent";
    }

    private String openSentence() {
        final boolean isOffline = Boolean.FALSE.equals(isAircraftOnline);
        if (!isSilent && !isOffline) {
            return "connected";
        }
        if (!isOffline && !keyFault.isEmpty()) {
            return securityText();
        }
        if (!isOffline && keyName.isEmpty() && unprotected > 0) {
            return KeyTexts.fault("key_missing");
        }
        final String code = silenceCode();
        return code.equals("silent") && frames == 0 ? "connected, no telemetry yet"
                : TelemetrySchema.EVENTS.get(code).text;
    }

    /** How far the connection to the other side is. */
    public enum LinkState {
        STOPPED,
        /** In progress: connecting, or waiting for the answer to the hello. */
        CONNECTING,
        OPEN,
        /** Lost or refused: it is tried again after a little wait. */
        WAITING
    }
}
