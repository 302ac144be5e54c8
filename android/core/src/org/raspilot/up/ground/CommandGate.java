package org.raspilot.up.ground;

import java.util.Arrays;
import java.util.List;
import java.util.Map;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.CommandForm;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.loop.Loop;

/**
 * The one place of the phone that decides whether a Command is offered, and whether it is sent.
 *
 * <p>An unknown condition is not an objection: the aircraft decides (docs/protocols.md 4).
 */
public final class CommandGate {
    private static final String OBSERVER = "observer";
    private static final List<String> ROLES =
            Arrays.asList(OBSERVER, "operator", "pilot", "admin");

    private final Loop loop;
    private final GroundSettings settings;
    private final GroundLink link;
    private final PendingCommands answers;
    private final ShownBeacons beacons;

    CommandGate(Loop loop, GroundSettings settings, GroundLink link, PendingCommands answers,
            ShownBeacons beacons) {
        this.loop = loop;
        this.settings = settings;
        this.link = link;
        this.answers = answers;
        this.beacons = beacons;
    }

    /** Returns whether a Command with such data only requests data, as any observer may. */
    public static boolean isOnlyRequest(CommandForm form, Map<String, ?> data) {
        return form.role(data).equals(OBSERVER);
    }

    /**
     * Returns why a Command is not offered.
     *
     * @param data the known fields
     * @param status null: the service is not connected yet
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

    /**
     * Returns why a Command is not sent now; null: it is.
     *
     * @param shown the beacon of the frame that the pilot has seen; null: none
     */
    Answer refusal(BaseCommand command, Long shown) {
        final Answer refused = ofLink(command);
        if (refused != null) {
            return refused;
        }
        if (answers.waiting() >= PendingCommands.MAX_WAITING) {
            return Answer.refused(command.name(), "busy",
                    "too many Commands wait for their answer");
        }
        final LinkStatus facts = link.facts();
        if (!facts.keyFault().isEmpty()) {
            return Answer.refused(command.name(), facts.keyFault(),
                    KeyTexts.fault(facts.keyFault()));
        }
        return PendingCommands.isRequest(command) && !facts.isKeyed() ? null
                : beaconFault(command, shown);
    }

    /** Returns the state of the seat; a seat we left is not ours, even while unconfirmed. */
    ControlStatus standing() {
        return ControlStatus.of(link.facts(), settings.isDirect);
    }

    /** Returns whether a role includes the required one; an unknown role is accepted. */
    static boolean allows(String role, String needed) {
        return !ROLES.contains(role)
                || ROLES.contains(needed) && ROLES.indexOf(role) >= ROLES.indexOf(needed);
    }

    /** Returns the objection from the aircraft's telemetry, or from its silence. */
    static DisabledReason ofAircraft(String name, Boolean tuneInFlight, Telemetry telemetry,
            long nowMs) {
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

    private Answer ofLink(BaseCommand command) {
        final LinkStatus facts = link.facts();
        switch (ofLink(link.isOpen(), facts.isAircraftOnline, standing())) {
            case NONE:
                return null;
            case NO_LINK:
                return Answer.refused(command.name(), "no_link",
                        facts.reason.isEmpty() ? "not connected"
                                : "not connected: " + facts.reason);
            case NO_AIRCRAFT:
                return Answer.refused(command.name(), "no_aircraft", "the aircraft "
                        + settings.aircraft + " is not connected to the proxy");
            default:
                return Answer.refused(command.name(), "no_control",
                        "this ground only listens: request control first");
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

    /** A pilot must see the aircraft's state to command: the screen may hang or show late data. */
    private Answer beaconFault(BaseCommand command, Long shown) {
        if (shown == null) {
            if (beacons.isLegacy() && !command.name().equals(Commands.ARM)
                    && !command.name().equals(Commands.DISARM)) {
                // A thesis aircraft's telemetry has no beacons.
                return null;
            }
            return Answer.refused(command.name(), "no_beacon",
                    "it is only sent with the beacon of telemetry that was seen");
        }
        if (!beacons.isFresh(shown, loop.nowMs())) {
            return Answer.refused(command.name(), "stale", "the telemetry on the screen is older"
                    + " than " + beacons.limitMs() / 1000 + " s");
        }
        return null;
    }

    /** Why a Command is not offered now. */
    public enum DisabledReason {
        /** It is offered. */
        NONE,
        /** No link to send it over. */
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
        /** The motor is armed already. */
        ARMED_ALREADY,
        /** The motor is disarmed already. */
        DISARMED_ALREADY
    }
}
