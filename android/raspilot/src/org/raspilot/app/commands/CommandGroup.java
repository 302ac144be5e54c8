package org.raspilot.app.commands;

import java.util.Locale;
import java.util.Map;
import org.raspilot.up.commands.CommandForm;
import org.raspilot.up.ground.CommandGate;

/** What belongs together in the list of Commands. */
public enum CommandGroup {
    FLIGHT,
    BOARD,
    DATA,
    PHONE,
    OTHER;

    static CommandGroup of(String name) {
        if (name.startsWith("up.telemetry.") || name.startsWith("black_box.")) {
            return DATA;
        }
        if (name.startsWith("up.")) {
            return FLIGHT;
        }
        if (name.startsWith("arduino.")) {
            return BOARD;
        }
        return name.startsWith("android.") ? PHONE : OTHER;
    }

    /**
     * Returns whether a Command needs a confirmation: every Command that changes the flight, and
     * every unknown one. Requests, speech, marks and telemetry periods need none.
     */
    static boolean isConfirmed(CommandForm form, Map<String, ?> data) {
        if (CommandGate.isOnlyRequest(form, data)) {
            return false;
        }
        switch (of(form.name)) {
            case DATA:
                return false;
            case PHONE:
                return !form.name.equals("android.speak");
            default:
                return true;
        }
    }

    /** Returns whether each of the words occurs in one of the texts, ignoring case. */
    public static boolean matches(String words, String... texts) {
        for (String word : words.trim().toLowerCase(Locale.ROOT).split("\\s+")) {
            boolean isFound = false;
            for (String text : texts) {
                isFound |= text.toLowerCase(Locale.ROOT).contains(word);
            }
            if (!isFound) {
                return false;
            }
        }
        return true;
    }
}
