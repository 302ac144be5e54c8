package org.raspilot.up.ground;

import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.ground.GainsService.GainChange;

/** The title of a Command, and the description of a sent one and of its outcome. */
public final class CommandTexts {
    private static final int SHOWN_CHANGES = 4;
    private static final Map<String, String> TITLES = new HashMap<>();
    private static final String VALUE = "{}";

    static {
        // schema begin
        TITLES.put("android.speak", "Speak \"{}\"");
        TITLES.put("arduino.calibrate", "Calibrate {}");
        TITLES.put("arduino.pids.tunings", "Gains");
        TITLES.put("arduino.profile.request", "Request the profile");
        TITLES.put("black_box.mark", "Mark \"{}\"");
        TITLES.put("up.arm", "Arm");
        TITLES.put("up.battery.calibrate", "Flight battery has {} V");
        TITLES.put("up.disarm", "Disarm");
        TITLES.put("up.flight_mode.set", "Flight mode {}");
        TITLES.put("up.home.set", "Set home");
        TITLES.put("up.mission.commit", "Use the plan");
        TITLES.put("up.mission.item", "Next item");
        TITLES.put("up.mission.part", "Part of a plan");
        TITLES.put("up.mission.request", "Read the plan");
        TITLES.put("up.navigation.target", "Target");
        TITLES.put("up.parameter.request", "Request parameters");
        TITLES.put("up.parameter.set", "Set parameter");
        TITLES.put("up.telemetry.frequency", "Telemetry period {} ms");
        // schema end
    }

    private CommandTexts() {
    }

    /** Returns what a person calls a Command, without its value; its name if it has no title. */
    public static String title(String name) {
        final String title = TITLES.get(name);
        return title == null ? name : title.replaceFirst("[ \"]*\\{.*", "");
    }

    /** Returns a Command in words, with the value of its only field. */
    static String of(BaseCommand command) {
        final String title = TITLES.get(command.name());
        final Collection<Object> values = command.data().values();
        return title == null || !title.contains(VALUE) || values.size() != 1
                ? title(command.name())
                : title.replace(VALUE,
                        String.valueOf(values.iterator().next()).replace('_', ' '));
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

    static String outcome(String words, Answer answer) {
        return words + ": " + answer.outcome.text()
                + (answer.isAck() || answer.why().isEmpty() ? "" : ": " + answer.why());
    }
}
