package org.raspilot.app.commands;

import java.util.Map;

/** Decides which Commands are sent only after a question. */
final class Caution {
    private Caution() {
    }

    /**
     * Says whether a Command is confirmed first: all that changes how it flies, and all that nobody
     * here knows. What only asks, speaks, marks or sets a period is not.
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
