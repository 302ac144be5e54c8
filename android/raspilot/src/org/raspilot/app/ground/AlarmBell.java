package org.raspilot.app.ground;

import java.util.Arrays;
import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Set;
import org.raspilot.up.ground.EventLevel;

/**
 * Decides when alarms sound: immediately, and repeatedly while their cause lasts, unless silenced.
 *
 * <p>Silencing applies to the alarms of that moment: a new alarm sounds, and so does the same one
 * when it returns or escalates from a warning to an alarm.
 */
final class AlarmBell {
    static final long ALARM_EACH_MS = 2000;
    static final long WARNING_EACH_MS = 10000;

    private final Set<String> silenced = new HashSet<>();
    private final Set<String> heard = new HashSet<>();
    private Map<String, EventLevel> loud = new HashMap<>();
    private long rangMs;
    private boolean hasRung;

    /** Takes the current audible alarms, by their kind. */
    void update(Map<String, EventLevel> wrong) {
        loud = new HashMap<>(wrong);
        Set<String> words = words();
        silenced.retainAll(words);
        heard.retainAll(words);
    }

    void silence() {
        silenced.addAll(words());
    }

    /** Returns the silenced alarms, for {@link #restore} of another bell. */
    String[] silenced() {
        return silenced.toArray(new String[0]);
    }

    /** Silences what another bell had silenced. */
    void restore(String[] words) {
        silenced.addAll(Arrays.asList(words));
    }

    boolean isRinging() {
        return worst() != null;
    }

    /** Returns what is to sound at this moment; null: nothing. */
    EventLevel ringAt(long nowMs) {
        EventLevel worst = worst();
        if (worst == null) {
            return null;
        }
        long eachMs = worst == EventLevel.ALARM ? ALARM_EACH_MS : WARNING_EACH_MS;
        Set<String> sounding = words();
        sounding.removeAll(silenced);
        boolean isNew = !heard.containsAll(sounding);
        long sinceMs = nowMs - rangMs;
        // Another service has another clock: a time in the future is invalid.
        if (hasRung && !isNew && sinceMs >= 0 && sinceMs < eachMs) {
            return null;
        }
        heard.addAll(sounding);
        hasRung = true;
        rangMs = nowMs;
        return worst;
    }

    private EventLevel worst() {
        EventLevel worst = null;
        for (Map.Entry<String, EventLevel> each : loud.entrySet()) {
            boolean isWorse = worst == null || each.getValue().compareTo(worst) > 0;
            if (isWorse && !silenced.contains(word(each))) {
                worst = each.getValue();
            }
        }
        return worst;
    }

    private Set<String> words() {
        Set<String> words = new HashSet<>();
        for (Map.Entry<String, EventLevel> each : loud.entrySet()) {
            words.add(word(each));
        }
        return words;
    }

    private static String word(Map.Entry<String, EventLevel> each) {
        return each.getKey() + " " + each.getValue();
    }
}
