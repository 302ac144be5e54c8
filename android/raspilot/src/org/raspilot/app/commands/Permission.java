package org.raspilot.app.commands;

import java.util.Arrays;
import java.util.List;
import java.util.Map;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.ground.Freshness;
import org.raspilot.up.ground.GroundStatus;
import org.raspilot.up.ground.Telemetry;

/**
 * Decides whether a Command may be offered, as far as that is known before it is sent.
 *
 * <p>An unknown condition is not an objection: the aircraft decides (docs/protocols.md 4).
 */
final class Permission {
    private static final String PROFILE = "arduino.profile.request";
    private static final String OBSERVER = "observer";
    private static final String OPERATOR = "operator";
    private static final String PILOT = "pilot";
    private static final List<String> ROLES =
            Arrays.asList(OBSERVER, OPERATOR, PILOT, "admin");

    private Permission() {
    }

    /** Returns whether a Command with such data is only a request. */
    static boolean isOnlyRequest(String name, Map<String, ?> data) {
        return name.equals(PROFILE) || name.equals(Commands.PIDS)
                && Boolean.TRUE.equals(data.get("request"));
    }

    /**
     * Returns the minimum role that a Command needs.
     *
     * @param told by the catalogue; {@code depends}: a field decides
     */
    static String neededRole(String name, String told, Map<String, ?> data) {
        if (ROLES.contains(told)) {
            return told;
        }
        if (isOnlyRequest(name, data)) {
            return OBSERVER;
        }
        return name.equals(Commands.PIDS) ? PILOT : OPERATOR;
    }

    /** Returns whether a role includes the required one; an unknown role is accepted. */
    static boolean allows(String role, String needed) {
        return !ROLES.contains(role) || ROLES.indexOf(role) >= ROLES.indexOf(needed);
    }

    /**
     * Returns why a Command is not offered.
     *
     * @param name of the Command
     * @param told the role that the catalogue states
     * @param data the known fields
     * @param status null: the service is not connected yet
     */
    static DisabledReason objection(String name, String told, Map<String, ?> data,
            GroundStatus status, Telemetry telemetry, long nowMs) {
        DisabledReason ofLink = ofLink(status);
        if (ofLink != DisabledReason.NONE) {
            return ofLink;
        }
        if (!allows(status.commandRole, neededRole(name, told, data))) {
            return DisabledReason.ROLE;
        }
        return ofAircraft(name, data, status.tuneInFlight, telemetry, nowMs);
    }

    /** Returns the objection from the aircraft's telemetry, or from its silence. */
    static DisabledReason ofAircraft(String name, Map<String, ?> data, Boolean tuneInFlight,
            Telemetry telemetry, long nowMs) {
        if (isOnlyRequest(name, data)) {
            return DisabledReason.NONE;
        }
        if (telemetry.isSilent(nowMs)) {
            return DisabledReason.SILENT;
        }
        boolean isLive = telemetry.freshness("armed", nowMs) == Freshness.LIVE;
        boolean isForAir = name.equals(Commands.PIDS)
                && telemetry.flag("in_flight") != null;
        Boolean flag = telemetry.flag(isForAir ? "in_flight" : "armed");
        return ofMotor(name, isLive ? flag : null, tuneInFlight);
    }

    /** Returns why nothing can be sent at all. */
    static DisabledReason ofLink(GroundStatus status) {
        if (status == null || !status.isOpen()) {
            return DisabledReason.NO_LINK;
        }
        if (Boolean.FALSE.equals(status.isAircraftOnline)) {
            return DisabledReason.NO_AIRCRAFT;
        }
        switch (status.control) {
            case OURS:
                return DisabledReason.NONE;
            case FREE:
                return DisabledReason.CONTROL_FREE;
            case HELD:
                return DisabledReason.CONTROL_TAKEN;
            case LATER:
                return DisabledReason.LISTENING;
            default:
                return DisabledReason.NO_LINK;
        }
    }

    /** Returns the objection while armed (for gains: in flight); {@code isArmed} null: unknown. */
    static DisabledReason ofMotor(String name, Boolean isArmed, Boolean tuneInFlight) {
        if (isArmed == null) {
            return DisabledReason.NONE;
        }
        if (name.equals(Commands.PIDS)) {
            boolean isForbidden = isArmed && Boolean.FALSE.equals(tuneInFlight);
            return isForbidden ? DisabledReason.ARMED : DisabledReason.NONE;
        }
        if (name.equals(Commands.ARM)) {
            return isArmed ? DisabledReason.ARMED_ALREADY : DisabledReason.NONE;
        }
        if (name.equals(Commands.DISARM)) {
            return isArmed ? DisabledReason.NONE : DisabledReason.DISARMED_ALREADY;
        }
        return DisabledReason.NONE;
    }

    /**
     * Returns whether a Command needs a confirmation: every Command that changes the flight, and
     * every unknown one. Requests, speech, marks and telemetry periods need none.
     */
    static boolean isConfirmed(String name, Map<String, ?> data) {
        if (isOnlyRequest(name, data)) {
            return false;
        }
        switch (CommandGroup.of(name)) {
            case DATA:
                return false;
            case PHONE:
                return !name.equals("android.speak");
            default:
                return true;
        }
    }

    /** Why a Command is not offered now. */
    enum DisabledReason {
        /** It is offered. */
        NONE,
        /** No link to send it over. */
        NO_LINK,
        /** The proxy does not have the aircraft. */
        NO_AIRCRAFT,
        /** No ground commands: control must be requested. */
        CONTROL_FREE,
        /** Another ground commands. */
        CONTROL_TAKEN,
        /** This ground listens, and the owner of control is unknown. */
        LISTENING,
        /** The aircraft's link does not allow it to a ground. */
        ROLE,
        /** The pilot must see the aircraft's state to command. */
        SILENT,
        /** Gains are refused in flight. */
        ARMED,
        /** The motor is armed already. */
        ARMED_ALREADY,
        /** The motor is disarmed already. */
        DISARMED_ALREADY
    }
}
