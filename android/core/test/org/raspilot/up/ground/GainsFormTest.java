package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.util.Map;
import org.junit.Test;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.commands.InvalidCommandException;

/** Gains as a person types them. */
public final class GainsFormTest {
    private final Map<String, String> cells = GainsForm.cells(GainsServiceTest.set(3));

    private void refused(String path, String typed, String code, String field) {
        cells.put(path, typed);
        InvalidCommandException fault =
                assertThrows(InvalidCommandException.class, () -> GainsForm.read(cells));
        assertEquals(code + " " + field, fault.code + " " + fault.field);
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
        for (String typed : new String[] {"x", "NaN", "1e1", "-1", "51", "1.2.3"}) {
            refused("ratePIDs.ailerons.p", typed, "out_of_range", "ratePIDs.ailerons.p");
        }
        InvalidCommandException fault =
                assertThrows(InvalidCommandException.class, () -> GainsForm.read(cells));
        assertTrue(fault.getMessage().startsWith("rate roll P"));
    }

    @Test
    public void aFormThatIsNotWholeIsNoSet() {
        refused("ratePIDs.ailerons.p", "", "missing", "ratePIDs.ailerons.p");
        cells.put("ratePIDs.ailerons.p", "3");
        refused("stabPIDs.rudder.i", null, "missing", "stabPIDs.rudder.i");
        cells.put("stabPIDs.rudder.p", "");
        refused("stabPIDs.rudder.d", "", "incomplete", "pids");
        for (String term : GainKey.TERMS) {
            cells.put("ratePIDs.rudder." + term, "");
        }
        assertNull(GainsForm.read(cells).rate.rudder);
        refused("navPIDs.elevator.p", "1", "missing", "navPIDs.ailerons");
    }
}
