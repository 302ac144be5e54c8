package org.raspilot.app.commands;

/** Why a Command is not offered now. */
enum Objection {
    /** It is offered. */
    NONE,
    /** There is no link to send it over. */
    NO_LINK,
    /** The proxy does not have the aircraft. */
    NO_AIRCRAFT,
    /** Nobody commands: control must be asked for. */
    SEAT_FREE,
    /** Another ground commands. */
    SEAT_HELD,
    /** This ground listens, and nobody has told who commands. */
    LISTENING,
    /** The aircraft's link does not allow it to a ground. */
    ROLE,
    /** Nobody commands what they do not see. */
    SILENT,
    /** Gains are refused in flight. */
    ARMED,
    /** The motor is armed already. */
    ARMED_ALREADY,
    /** The motor is disarmed already. */
    DISARMED_ALREADY
}
