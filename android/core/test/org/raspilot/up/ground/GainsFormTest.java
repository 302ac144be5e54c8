package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.util.HashMap;
import java.util.Map;
import org.junit.Test;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.commands.InvalidCommandException;

/** Gains as a person types them. */
public final class GainsFormTest {
    private final GainSet active = GainsServiceTest.set(3);
    private final Map<GainKey, String> edits = new HashMap<>();

    private void type(String path, String typed) {
        for (GainKey key : GainKey.ALL) {
            if (key.path().equals(path)) {
                edits.put(key, typed);
            }
        }
    }

    private InvalidCommandException refused(String path, String typed, String code, String field) {
        type(path, typed);
        InvalidCommandException fault =
                assertThrows(InvalidCommandException.class, () -> GainsForm.read(edits, active));
        assertEquals(code + " " + field, fault.code + " " + fault.field);
        return fault;
    }

    @Test
    public void aFormThatNobodyTouchedIsTheSetItself() {
        assertEquals(active.toData(), GainsForm.read(edits, active).toData());
    }

    @Test
    public void numbersAreTakenWithACommaToo() {
        type("ratePIDs.ailerons.p", " 2,5 ");
        type("stabPIDs.rudder.d", "50");
        final GainSet set = GainsForm.read(edits, active);
        assertEquals(2.5, set.rate.ailerons.p, 0);
        assertEquals(50, set.stabilize.rudder.d, 0);
    }

    @Test
    public void oneGainIsReadAsTheFormReadsIt() {
        assertEquals(0.125, GainsForm.number(" 0,125 "), 0);
        assertEquals(50, GainsForm.number("50."), 0);
        for (String typed : new String[] {"", "51", "-1", "1e1", "0x1p3", "1d", "NaN", "1,0,0"}) {
            assertNull(typed, GainsForm.number(typed));
        }
    }

    @Test
    public void whatIsNoGainIsNamed() {
        for (String typed : new String[] {"x", "NaN", "1e1", "-1", "51", "1.2.3"}) {
            assertTrue(refused("ratePIDs.ailerons.p", typed, "out_of_range",
                    "ratePIDs.ailerons.p").getMessage().startsWith("rate roll P"));
        }
    }

    @Test
    public void aFormThatIsNotWholeIsNoSet() {
        refused("ratePIDs.ailerons.p", "", "missing", "ratePIDs.ailerons.p");
        type("ratePIDs.ailerons.p", "3");
        refused("stabPIDs.rudder.i", "", "missing", "stabPIDs.rudder.i");
        type("stabPIDs.rudder.p", "");
        refused("stabPIDs.rudder.d", "", "incomplete", "pids");
        for (String term : new String[] {"p", "i", "d"}) {
            type("ratePIDs.rudder." + term, "");
        }
        assertNull(GainsForm.read(edits, active).rate.rudder);
    }
}
