package org.raspilot.up.ground;

import java.util.Map;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.commands.InvalidCommandException;

/** Reads the gains that a person has typed. */
public final class GainsForm {
    private GainsForm() {
    }

    /**
     * Returns the set that the form holds.
     *
     * <p>Rate and stabilize must be whole for ailerons and elevator; the rudder is in both or in
     * neither; navigation is whole or empty, its rudder may be empty.
     *
     * @param cells the typed texts by {@link GainKey#path}; an empty one counts as absent
     * @throws InvalidCommandException with one sentence that names the gain
     */
    public static GainSet read(Map<String, String> cells) {
        throw new InvalidCommandException("rate roll P is missing");
    }
}
