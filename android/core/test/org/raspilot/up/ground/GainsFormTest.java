package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.fail;

import java.util.Map;
import org.junit.Test;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.commands.InvalidCommandException;

/** Gains as a person types them. */
public final class GainsFormTest {
    private final Map<String, String> cells = GainsForm.cells(GainsServiceTest.set(3));

    private void refused(String path, String typed, String sentence) {
        cells.put(path, typed);
        try {
            GainsForm.read(cells);
            fail("taken: " + typed);
        } catch (InvalidCommandException fault) {
            assertEquals(sentence, fault.getMessage());
        }
    }

    @Test
    public void aFormThatNobodyTouchedIsTheSetItself() {
        assertEquals(GainsServiceTest.set(3).toData(), GainsForm.read(cells).toData());
        assertEquals(27, cells.size());
        assertEquals("0.25", cells.get("ratePIDs.ailerons.d"));
        assertEquals("", cells.get("navPIDs.ailerons.p"));
    }

    @Test
    public void numbersAreTakenWithACommaToo() {
        cells.put("ratePIDs.ailerons.p", " 2,5 ");
        cells.put("stabPIDs.rudder.d", "50");
        final GainSet set = GainsForm.read(cells);
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
        refused("ratePIDs.ailerons.p", "x", "rate roll P must be a number, 0 to 50, not x");
        refused("ratePIDs.ailerons.p", "NaN", "rate roll P must be a number, 0 to 50, not NaN");
        refused("ratePIDs.ailerons.p", "1e1", "rate roll P must be a number, 0 to 50, not 1e1");
        refused("ratePIDs.ailerons.p", "-1", "rate roll P must be a number, 0 to 50, not -1");
        refused("ratePIDs.ailerons.p", "51", "rate roll P must be a number, 0 to 50, not 51");
        refused("ratePIDs.ailerons.p", "1.2.3",
                "rate roll P must be a number, 0 to 50, not 1.2.3");
    }

    @Test
    public void aFormThatIsNotWholeIsNoSet() {
        refused("ratePIDs.ailerons.p", "", "the set is not whole: rate roll P is missing");
        cells.put("ratePIDs.ailerons.p", "3");
        refused("stabPIDs.rudder.i", null, "the set is not whole: stabilize yaw I is missing");
        cells.put("stabPIDs.rudder.p", "");
        refused("stabPIDs.rudder.d", "", "the set is not whole: yaw must be in the rate and in the"
                + " stabilize loop, or in neither");
        for (String term : GainKey.TERMS) {
            cells.put("ratePIDs.rudder." + term, "");
        }
        assertNull(GainsForm.read(cells).rate.rudder);
        refused("navPIDs.elevator.p", "1",
                "the set is not whole: navigation roll P is missing");
    }
}
