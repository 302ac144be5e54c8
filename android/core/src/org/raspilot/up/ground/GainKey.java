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
    private static final String[] LOOPS = {"ratePIDs", "stabPIDs"};
    private static final String[] AXES = {"ailerons", "elevator", "rudder"};
    private static final String[] TERMS = {"p", "i", "d"};
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
        return LOOPS[loop];
    }

    public String axis() {
        return AXES[axis];
    }

    /** Returns {@code p}, {@code i} or {@code d}. */
    public String term() {
        return TERMS[term];
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
        final LoopGains inLoop = loop == 0 ? set.rate : set.stabilize;
        final Gains gains =
                axis == 0 ? inLoop.ailerons : axis == 1 ? inLoop.elevator : inLoop.rudder;
        if (gains == null) {
            return null;
        }
        return term == 0 ? gains.p : term == 1 ? gains.i : gains.d;
    }

    private static List<GainKey> all() {
        final List<GainKey> keys = new ArrayList<>();
        for (int each = 0; each < 18; each++) {
            keys.add(new GainKey(each / 9, each / 3 % 3, each % 3));
        }
        return Collections.unmodifiableList(keys);
    }
}
