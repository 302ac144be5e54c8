package org.raspilot.app.commands;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.util.Collections;
import org.junit.Test;
import org.raspilot.up.commands.GainSet.Gains;
import org.raspilot.up.commands.GainSet.LoopGains;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.commands.InvalidCommandException;
import org.raspilot.up.ground.GainKey;

public final class GainsEditorTest {
    private static final GainKey RATE_ROLL_P = GainKey.ALL.get(0);
    private static final GainKey RATE_PITCH_I = GainKey.ALL.get(4);
    private static final GainKey RATE_YAW_P = GainKey.ALL.get(6);
    private static final double SINGLE = 0.30000001192092896;

    private final GainsEditor editor = new GainsEditor();

    private static GainSet set(double rollP) {
        LoopGains rate = new LoopGains(new Gains(rollP, 0, 0.1), new Gains(2, SINGLE, 0), null);
        LoopGains stabilize = new LoopGains(new Gains(4, 0, 0), new Gains(5, 0, 0), null);
        return new GainSet(rate, stabilize);
    }

    @Test
    public void untouchedGainsGoBackExactlyAsTheyCame() {
        editor.setActive(set(3));
        editor.write(RATE_ROLL_P, "2.4");
        GainSet wanted = editor.wanted();
        assertEquals(2.4, wanted.rate.ailerons.p, 0);
        assertEquals(SINGLE, wanted.rate.elevator.i, 0);
        assertEquals(null, wanted.rate.rudder);
    }

    @Test
    public void cellsShowWhatFliesUntilTheyAreWritten() {
        editor.setActive(set(3));
        assertEquals("3.0", editor.textOf(RATE_ROLL_P));
        assertEquals("0.3", editor.textOf(RATE_PITCH_I));
        assertEquals("", editor.textOf(RATE_YAW_P));
        assertFalse(editor.hasEdits());
        editor.write(RATE_ROLL_P, "2.");
        assertEquals("2.", editor.textOf(RATE_ROLL_P));
        assertTrue(editor.isEdited(RATE_ROLL_P));
    }

    @Test
    public void writingWhatFliesIsNoEdit() {
        editor.setActive(set(3));
        editor.write(RATE_ROLL_P, "2");
        editor.write(RATE_ROLL_P, "3.00");
        assertFalse(editor.hasEdits());
        editor.write(RATE_YAW_P, "  ");
        assertFalse(editor.hasEdits());
    }

    @Test
    public void whatWasSentAndFliesNowIsNoEditAnyMore() {
        editor.setActive(set(3));
        editor.write(RATE_ROLL_P, "2.4");
        editor.setActive(null);
        assertTrue(editor.hasEdits());
        editor.setActive(set(2.4));
        assertFalse(editor.hasEdits());
    }

    @Test
    public void gainsThatChangedMeanwhileAreAConflictUntilTheyWereSeen() {
        editor.setActive(set(3));
        editor.write(RATE_ROLL_P, "2.4");
        assertTrue(editor.conflicts().isEmpty());
        editor.setActive(set(7));
        assertEquals(Collections.singletonList(RATE_ROLL_P), editor.conflicts());
        assertEquals("3.0", editor.seenText(RATE_ROLL_P));
        assertEquals("2.4", editor.textOf(RATE_ROLL_P));
        editor.write(RATE_ROLL_P, "2.5");
        assertEquals("3.0", editor.seenText(RATE_ROLL_P));
        editor.accept();
        assertTrue(editor.conflicts().isEmpty());
    }

    @Test
    public void noSetIsMadeOfWhatIsNoGain() {
        editor.setActive(set(3));
        for (String written : new String[] {"x", "-1", "50.1", "NaN", "1e999", ""}) {
            editor.write(RATE_ROLL_P, written);
            InvalidCommandException wrong = assertThrows(InvalidCommandException.class, () ->
                    editor.wanted());
            assertTrue(wrong.getMessage(), wrong.getMessage().contains("rate"));
            assertTrue(editor.changes().isEmpty());
            assertEquals(!written.isEmpty(), editor.isWrong(RATE_ROLL_P));
        }
    }

    @Test
    public void aCommaIsAPoint() {
        editor.setActive(set(3));
        editor.write(RATE_ROLL_P, "2,4");
        assertFalse(editor.isWrong(RATE_ROLL_P));
        assertEquals(2.4, editor.wanted().rate.ailerons.p, 0);
    }

    @Test
    public void aVerySmallGainIsKept() {
        editor.setActive(set(1e-5));
        editor.write(RATE_PITCH_I, "1");
        assertEquals(1e-5, editor.wanted().rate.ailerons.p, 0);
    }

    @Test
    public void theDifferenceNamesWhatSendingWouldChange() {
        editor.setActive(set(3));
        editor.write(RATE_ROLL_P, "2.4");
        assertEquals(1, editor.changes().size());
        assertEquals(RATE_ROLL_P, editor.changes().get(0).key);
        assertEquals(2.4, editor.changes().get(0).after, 0);
    }

    @Test
    public void whatWasWrittenCanBeTakenBack() {
        editor.setActive(set(3));
        editor.write(RATE_ROLL_P, "2.4");
        editor.discard();
        assertFalse(editor.hasEdits());
        assertEquals("3.0", editor.textOf(RATE_ROLL_P));
    }

    @Test
    public void withoutGainsThatFlyThereIsNoSet() {
        editor.write(RATE_ROLL_P, "2.4");
        assertThrows(InvalidCommandException.class, () -> editor.wanted());
    }
}
