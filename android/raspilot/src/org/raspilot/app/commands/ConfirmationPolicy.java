package org.raspilot.app.commands;

import java.util.Map;

/** Decides which Commands are sent only after a question. */
final class ConfirmationPolicy {
    private ConfirmationPolicy() {
    }

    /**
     * Returns whether a Command needs a confirmation: every Command that changes the flight, and
     * every unknown one. Requests, speech, marks and telemetry periods need none.
     */
    static boolean isConfirmed(String name, Map<String, ?> data) {
        if (Permission.isOnlyRequest(name, data)) {
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
}
