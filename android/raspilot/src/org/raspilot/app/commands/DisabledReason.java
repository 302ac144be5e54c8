package org.raspilot.app.commands;

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
    /** This ground listens, and it is unknown who commands. */
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
