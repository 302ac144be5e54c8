package org.raspilot.up.ground;

import java.util.HashMap;
import java.util.List;
import java.util.Map;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.ground.GainsService.GainChange;

/** The description of a Command and of its outcome in an event. */
final class CommandTexts {
    private static final int SHOWN_CHANGES = 4;
    private static final Map<String, String> WORDS = new HashMap<>();
    private static final Map<String, String> FIELDS = new HashMap<>();

    static {
        put("up.flight_mode.set", "flight mode %s", "mode");
        put("up.arm", "arm", "");
        put("up.disarm", "disarm", "");
        put("up.telemetry.frequency", "telemetry every %s ms", "frequency");
        put("android.speak", "say \"%s\"", "text");
        put("black_box.mark", "mark \"%s\"", "text");
        put("arduino.calibrate", "calibrate %s", "what");
        put("arduino.profile.request", "ask for the profile", "");
        put("arduino.pids.tunings", "ask for the gains", "");
    }

    private CommandTexts() {
    }

    /** Returns a Command in words; an unknown one by its name. */
    static String of(BaseCommand command) {
        final String words = WORDS.get(command.name());
        if (words == null) {
            return command.name();
        }
        return words.replace("%s", String.valueOf(command.data().get(FIELDS.get(command.name()))));
    }

    /** Returns in words what a set of gains changes. */
    static String ofGains(List<GainChange> changes) {
        final StringBuilder text = new StringBuilder("gains");
        for (int place = 0; place < Math.min(SHOWN_CHANGES, changes.size()); place++) {
            text.append(place == 0 ? ": " : ", ").append(changes.get(place));
        }
        if (changes.size() > SHOWN_CHANGES) {
            text.append(" and ").append(changes.size() - SHOWN_CHANGES).append(" more");
        }
        return text.toString();
    }

    /** Returns the outcome of a sent Command. */
    static String outcome(String words, Answer answer) {
        final String why = answer.reason.isEmpty() ? answer.code : answer.reason;
        return words + ": " + answer.outcome.text()
                + (answer.isAck() || why.isEmpty() ? "" : ": " + why);
    }

    private static void put(String name, String words, String field) {
        WORDS.put(name, words);
        FIELDS.put(name, field);
    }
}
