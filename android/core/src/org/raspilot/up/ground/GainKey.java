package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Locale;
import org.raspilot.up.commands.GainSet.Gains;
import org.raspilot.up.commands.GainSet.LoopGains;
import org.raspilot.up.commands.GainSet;

/** Names one gain: loop, axis and term. Immutable. */
public final class GainKey {
    /** The loops under their names on the wire: rate, stabilize. */
    public static final List<String> LOOPS = list("ratePIDs", "stabPIDs");
    /** The axes under their names on the wire. */
    public static final List<String> AXES = list("ailerons", "elevator", "rudder");
    public static final List<String> TERMS = list("p", "i", "d");
    /** All 18 gains: loops, in them axes, in them terms. */
    public static final List<GainKey> ALL = all();

    private static final String[] LOOP_WORDS = {"rate", "stabilize"};
    private static final String[] AXIS_WORDS = {"roll", "pitch", "yaw"};

    private final int loop;
    private final int axis;
    private final int term;

    private GainKey(int loop, int axis, int term) {
        this.loop = loop;
        this.axis = axis;
        this.term = term;
    }

    /** Returns the loop's name on the wire. */
    public String loop() {
        return LOOPS.get(loop);
    }

    /** Returns the axis' name on the wire. */
    public String axis() {
        return AXES.get(axis);
    }

    /** Returns {@code p}, {@code i} or {@code d}. */
    public String term() {
        return TERMS.get(term);
    }

    /** Returns {@code ratePIDs.ailerons.p}. */
    public String path() {
        return loop() + "." + axis() + "." + term();
    }

    /** Returns {@code rate roll P}. */
    public String words() {
        return LOOP_WORDS[loop] + " " + AXIS_WORDS[axis] + " " + term().toUpperCase(Locale.ROOT);
    }

    /** Returns whether a controller uses it; none holds a yaw angle. */
    public boolean isUsed() {
        return loop == 0 || axis < 2;
    }

    /** Returns this gain of a set; null: the set has none or is null. */
    public Double of(GainSet set) {
        if (set == null) {
            return null;
        }
        final LoopGains inLoop = loopOf(set);
        if (inLoop == null) {
            return null;
        }
        final Gains gains =
                axis == 0 ? inLoop.ailerons : axis == 1 ? inLoop.elevator : inLoop.rudder;
        if (gains == null) {
            return null;
        }
        return term == 0 ? gains.p : term == 1 ? gains.i : gains.d;
    }

    @Override
    public String toString() {
        return path();
    }

    private LoopGains loopOf(GainSet set) {
        return loop == 0 ? set.rate : set.stabilize;
    }

    private static List<GainKey> all() {
        final List<GainKey> keys = new ArrayList<>();
        for (int each = 0; each < 18; each++) {
            keys.add(new GainKey(each / 9, each / 3 % 3, each % 3));
        }
        return Collections.unmodifiableList(keys);
    }

    private static List<String> list(String... words) {
        final List<String> copy = new ArrayList<>();
        Collections.addAll(copy, words);
        return Collections.unmodifiableList(copy);
    }
}
