package org.raspilot.up.commands;

import java.util.Arrays;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/**
 * A complete set of gains: rate (1.25 us per deg/s), stabilize (deg/s per deg).
 *
 * <p>Source: docs/protocols.md 5, {@code arduino.pids.tunings} and {@code arduino.pids.values}.
 */
public final class GainSet {
    private static final List<String> NOTHING = Collections.emptyList();

    public final LoopGains rate;
    public final LoopGains stabilize;

    public GainSet(LoopGains rate, LoopGains stabilize) {
        this.rate = rate;
        this.stabilize = stabilize;
    }

    /**
     * Parses {@code {ratePIDs, stabPIDs, navPIDs?}}, the form that {@code arduino.pids.values} uses
     * too; a set is accepted whole or not at all. The result is without {@code navPIDs}, which no
     * controller uses.
     *
     * @throws InvalidCommandException with one sentence that names the place
     */
    public static GainSet ofData(Map<String, ?> data) {
        only(data, Arrays.asList("ratePIDs", "stabPIDs"), Arrays.asList("navPIDs"), "pids");
        LoopGains rate = loop(data.get("ratePIDs"), "ratePIDs");
        LoopGains stabilize = loop(data.get("stabPIDs"), "stabPIDs");
        if ((rate.rudder == null) != (stabilize.rudder == null)) {
            throw new InvalidCommandException("incomplete", "pids",
                    "must have a rudder in both loops or in none");
        }
        Object navigation = data.get("navPIDs");
        if (navigation != null) {
            loop(navigation, "navPIDs");
        }
        return new GainSet(rate, stabilize);
    }

    /** Returns the set in the form of the wire; nothing is rounded. */
    public Map<String, Object> toData() {
        Map<String, Object> data = new LinkedHashMap<>();
        data.put("ratePIDs", loopData(rate));
        data.put("stabPIDs", loopData(stabilize));
        return data;
    }

    private static LoopGains loop(Object value, String place) {
        Map<?, ?> data = only(value, Arrays.asList("ailerons", "elevator"),
                Arrays.asList("rudder"), place);
        Object rudder = data.get("rudder");
        return new LoopGains(
                gains(data.get("ailerons"), place + ".ailerons"),
                gains(data.get("elevator"), place + ".elevator"),
                rudder == null ? null : gains(rudder, place + ".rudder"));
    }

    private static Gains gains(Object value, String place) {
        Map<?, ?> data = only(value, Arrays.asList("p", "i", "d"), NOTHING, place);
        return new Gains(gain(data, "p", place), gain(data, "i", place), gain(data, "d", place));
    }

    private static double gain(Map<?, ?> data, String key, String place) {
        FieldRule.number(0, Gains.MAX).check(place + "." + key, data.get(key));
        return ((Number) data.get(key)).doubleValue();
    }

    private static Map<?, ?> only(Object value, List<String> required, List<String> optional,
            String place) {
        if (!(value instanceof Map)) {
            throw new InvalidCommandException("wrong_type", place, "must be an object");
        }
        Map<?, ?> data = (Map<?, ?>) value;
        for (String key : required) {
            if (!data.containsKey(key)) {
                throw new InvalidCommandException("missing", place + "." + key, "is missing");
            }
        }
        for (Object key : data.keySet()) {
            if (!required.contains(key) && !optional.contains(key)) {
                throw new InvalidCommandException("unknown", place + "." + key, "is not known");
            }
        }
        return data;
    }

    private static Map<String, Object> loopData(LoopGains loop) {
        Map<String, Object> data = new LinkedHashMap<>();
        data.put("ailerons", gainsData(loop.ailerons));
        data.put("elevator", gainsData(loop.elevator));
        if (loop.rudder != null) {
            data.put("rudder", gainsData(loop.rudder));
        }
        return data;
    }

    private static Map<String, Object> gainsData(Gains gains) {
        Map<String, Object> data = new LinkedHashMap<>();
        data.put("p", gains.p);
        data.put("i", gains.i);
        data.put("d", gains.d);
        return data;
    }

    /** The gains of one loop on every axis; without a rudder the set is the two-axis form. */
    public static final class LoopGains {
        public final Gains ailerons;
        public final Gains elevator;
        /** The gains of the rudder, or null. */
        public final Gains rudder;

        /** Creates the gains of a loop; {@code rudder} null: unchanged. */
        public LoopGains(Gains ailerons, Gains elevator, Gains rudder) {
            this.ailerons = ailerons;
            this.elevator = elevator;
            this.rudder = rudder;
        }
    }

    /** The three gains of one PID controller, each 0 to 50 (docs/protocols.md 5). */
    public static final class Gains {
        public static final double MAX = 50;

        public final double p;
        public final double i;
        public final double d;

        /** Creates the gains of one controller; {@link PidTuningsCommand} checks them. */
        public Gains(double p, double i, double d) {
            this.p = p;
            this.i = i;
            this.d = d;
        }
    }
}
