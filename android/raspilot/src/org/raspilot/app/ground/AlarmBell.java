package org.raspilot.app.ground;

import java.util.Arrays;
import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Set;

/**
 * Decides when alarms sound: at once, again and again while their cause lasts, not when silenced.
 *
 * <p>Silencing is for what is on at that moment: another alarm sounds, and so does the same one
 * when it comes back or turns from a warning into an alarm.
 */
final class AlarmBell {
    /** An alarm is repeated so often. */
    static final long ALARM_EACH_MS = 2000;
    /** A warning is repeated so often. */
    static final long WARNING_EACH_MS = 10000;

    /** What is to be heard. */
    enum Ring {
        /** Nothing. */
        NONE,
        /** A warning. */
        WARNING,
        /** An alarm. */
        ALARM
    }

    private final Set<String> silenced = new HashSet<String>();
    private final Set<String> heard = new HashSet<String>();
    private Map<String, Ring> loud = new HashMap<String, Ring>();
    private long rangMs;
    private boolean hasRung;

    /** Takes what is wrong now and loud, by its kind. */
    void take(Map<String, Ring> wrong) {
        loud = new HashMap<String, Ring>(wrong);
        Set<String> words = words();
        silenced.retainAll(words);
        heard.retainAll(words);
    }

    /** Silences what is wrong now. */
    void silence() {
        silenced.addAll(words());
    }

    /** Returns what is silenced, for {@link #restore} of another bell. */
    String[] silenced() {
        return silenced.toArray(new String[0]);
    }

    /** Silences what another bell had silenced. */
    void restore(String[] words) {
        silenced.addAll(Arrays.asList(words));
    }

    /** Says whether something is wrong that was silenced. */
    boolean isSilenced() {
        return !silenced.isEmpty();
    }

    /** Says whether something is wrong that sounds. */
    boolean isRinging() {
        return worst() != Ring.NONE;
    }

    /** Returns what is to be heard at this moment. */
    Ring look(long nowMs) {
        Ring worst = worst();
        if (worst == Ring.NONE) {
            return Ring.NONE;
        }
        long eachMs = worst == Ring.ALARM ? ALARM_EACH_MS : WARNING_EACH_MS;
        Set<String> sounding = words();
        sounding.removeAll(silenced);
        boolean isNew = !heard.containsAll(sounding);
        long sinceMs = nowMs - rangMs;
        // Another service has another clock: what lies ahead of now is no moment to wait for.
        if (hasRung && !isNew && sinceMs >= 0 && sinceMs < eachMs) {
            return Ring.NONE;
        }
        heard.addAll(sounding);
        hasRung = true;
        rangMs = nowMs;
        return worst;
    }

    private Ring worst() {
        Ring worst = Ring.NONE;
        for (Map.Entry<String, Ring> each : loud.entrySet()) {
            boolean isWorse = each.getValue().compareTo(worst) > 0;
            if (isWorse && !silenced.contains(word(each))) {
                worst = each.getValue();
            }
        }
        return worst;
    }

    private Set<String> words() {
        Set<String> words = new HashSet<String>();
        for (Map.Entry<String, Ring> each : loud.entrySet()) {
            words.add(word(each));
        }
        return words;
    }

    private static String word(Map.Entry<String, Ring> each) {
        return each.getKey() + " " + each.getValue();
    }
}
