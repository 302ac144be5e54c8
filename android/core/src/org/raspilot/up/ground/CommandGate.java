package org.raspilot.up.ground;

import java.util.Arrays;
import java.util.List;
import java.util.Map;
import org.raspilot.up.commands.CommandForm;
import org.raspilot.up.commands.Commands;

/**
 * Decides whether a Command is offered; {@link CommandService} checks it again when it is sent.
 *
 * <p>An unknown condition is not an objection: the aircraft decides (docs/protocols.md 4).
 */
public final class CommandGate {
    private static final String OBSERVER = "observer";
    private static final List<String> ROLES =
            Arrays.asList(OBSERVER, "operator", "pilot", "admin");

    private CommandGate() {
    }

    /** Returns whether a Command with such data only requests data, as any observer may. */
    public static boolean isOnlyRequest(CommandForm form, Map<String, ?> data) {
        return form.role(data).equals(OBSERVER);
    }

    /**
     * Returns why a Command with the known fields is not offered; {@code status} null: no service.
     */
    public static DisabledReason objection(CommandForm form, Map<String, ?> data,
            GroundStatus status, Telemetry telemetry, long nowMs) {
        DisabledReason ofLink = status == null ? DisabledReason.NO_LINK
                : ofLink(status.isOpen(), status.isAircraftOnline, status.control);
        if (ofLink == DisabledReason.NONE && !status.keyFault.isEmpty()) {
            return DisabledReason.NO_SESSION;
        }
        if (ofLink != DisabledReason.NONE) {
            return ofLink;
        }
        if (!allows(status.commandRole, form.role(data))) {
            return DisabledReason.ROLE;
        }
        return isOnlyRequest(form, data) ? DisabledReason.NONE
                : ofAircraft(form.name, status.tuneInFlight, telemetry, nowMs);
    }

    /** Returns whether a role includes the required one; an unknown role is accepted. */
    static boolean allows(String role, String needed) {
        return !ROLES.contains(role)
                || ROLES.contains(needed) && ROLES.indexOf(role) >= ROLES.indexOf(needed);
    }

    static DisabledReason ofAircraft(String name, Boolean tuneInFlight, Telemetry telemetry,
            long nowMs) {
        if (telemetry.age.isSilent(nowMs)) {
            return DisabledReason.SILENT;
        }
        boolean isLive = telemetry.freshness("armed", nowMs) == Freshness.LIVE;
        boolean isForAir = name.equals(Commands.PIDS)
                && telemetry.flag("in_flight") != null;
        Boolean flag = telemetry.flag(isForAir ? "in_flight" : "armed");
        return ofMotor(name, isLive ? flag : null, tuneInFlight);
    }

    /** Returns why nothing can be sent at all. */
    static DisabledReason ofLink(boolean isOpen, Boolean isAircraftOnline,
            ControlStatus control) {
        if (!isOpen) {
            return DisabledReason.NO_LINK;
        }
        if (Boolean.FALSE.equals(isAircraftOnline)) {
            return DisabledReason.NO_AIRCRAFT;
        }
        switch (control) {
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

    /** Why a Command is not offered now. */
    public enum DisabledReason {
        NONE,
        NO_LINK,
        /** The proxy does not have the aircraft. */
        NO_AIRCRAFT,
        /** The link requires a protected session, and there is none. */
        NO_SESSION,
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
        ARMED_ALREADY,
        DISARMED_ALREADY
    }
}
