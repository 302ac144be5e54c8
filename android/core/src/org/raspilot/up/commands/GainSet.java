package org.raspilot.up.commands;

import java.util.LinkedHashMap;
import java.util.Map;

/**
 * A complete set of gains: rate (1.25 us per deg/s), stabilize (deg/s per deg), navigation.
 *
 * <p>Source: docs/protocols.md 5, {@code arduino.pids.tunings} and {@code arduino.pids.values}.
 */
public final class GainSet {
    private final LoopGains rate;
    private final LoopGains stabilize;
    private final LoopGains navigation;

    /** Makes a set; {@code navigation} null: it stays as it is. */
    public GainSet(LoopGains rate, LoopGains stabilize, LoopGains navigation) {
        this.rate = rate;
        this.stabilize = stabilize;
        this.navigation = navigation;
    }

    /**
     * Reads {@code {ratePIDs, stabPIDs, navPIDs?}}, as {@code arduino.pids.values} tells it too.
     *
     * @throws InvalidCommandException with one sentence that names the place
     */
    public static GainSet ofData(Map<String, Object> data) {
        throw new InvalidCommandException("pids.ratePIDs is missing");
    }

    /** Returns the set in the form of the wire; nothing is rounded. */
    public Map<String, Object> toData() {
        return new LinkedHashMap<String, Object>();
    }

    /** Returns the gains of the rate loop. */
    public LoopGains rate() {
        return rate;
    }

    /** Returns the gains of the stabilize loop. */
    public LoopGains stabilize() {
        return stabilize;
    }

    /** Returns the gains of navigation, or null. */
    public LoopGains navigation() {
        return navigation;
    }
}
