package org.raspilot.app.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.util.HashMap;
import java.util.Map;
import org.junit.Test;

public final class AlarmBellTest {
    private final AlarmBell bell = new AlarmBell();

    private void wrong(Object... kindsAndRings) {
        Map<String, AlarmBell.Ring> loud = new HashMap<>();
        for (int each = 0; each < kindsAndRings.length; each += 2) {
            loud.put((String) kindsAndRings[each], (AlarmBell.Ring) kindsAndRings[each + 1]);
        }
        bell.take(loud);
    }

    @Test
    public void withoutACauseNothingSounds() {
        wrong();
        assertEquals(AlarmBell.Ring.NONE, bell.look(0));
        assertFalse(bell.isRinging());
    }

    @Test
    public void anAlarmSoundsAtOnceAndEachTwoSeconds() {
        wrong("SILENT", AlarmBell.Ring.ALARM);
        assertEquals(AlarmBell.Ring.ALARM, bell.look(5000));
        assertEquals(AlarmBell.Ring.NONE, bell.look(6999));
        assertEquals(AlarmBell.Ring.ALARM, bell.look(7000));
    }

    @Test
    public void aWarningIsRepeatedSeldom() {
        wrong("PHONE", AlarmBell.Ring.WARNING);
        assertEquals(AlarmBell.Ring.WARNING, bell.look(0));
        assertEquals(AlarmBell.Ring.NONE, bell.look(9999));
        assertEquals(AlarmBell.Ring.WARNING, bell.look(10000));
    }

    @Test
    public void whatIsNewSoundsAtOnceBesideWhatSoundsAlready() {
        wrong("PHONE", AlarmBell.Ring.WARNING);
        bell.look(0);
        wrong("PHONE", AlarmBell.Ring.WARNING, "BATTERY", AlarmBell.Ring.WARNING);
        assertEquals(AlarmBell.Ring.WARNING, bell.look(100));
        wrong("PHONE", AlarmBell.Ring.WARNING, "BATTERY", AlarmBell.Ring.ALARM);
        assertEquals(AlarmBell.Ring.ALARM, bell.look(200));
    }

    @Test
    public void whatIsSilencedStaysSoWhileItLasts() {
        wrong("SILENT", AlarmBell.Ring.ALARM);
        bell.look(0);
        bell.silence();
        assertEquals(AlarmBell.Ring.NONE, bell.look(60000));
        assertFalse(bell.isRinging());
        assertTrue(bell.isSilenced());
    }

    @Test
    public void anotherAlarmSoundsThroughTheSilence() {
        wrong("SILENT", AlarmBell.Ring.ALARM);
        bell.look(0);
        bell.silence();
        wrong("SILENT", AlarmBell.Ring.ALARM, "BOARD", AlarmBell.Ring.ALARM);
        assertEquals(AlarmBell.Ring.ALARM, bell.look(100));
    }

    @Test
    public void aWarningThatBecomesAnAlarmSoundsAgain() {
        wrong("RECEIVER", AlarmBell.Ring.WARNING);
        bell.silence();
        wrong("RECEIVER", AlarmBell.Ring.ALARM);
        assertEquals(AlarmBell.Ring.ALARM, bell.look(100));
    }

    @Test
    public void whatComesBackSoundsAgain() {
        wrong("SILENT", AlarmBell.Ring.ALARM);
        bell.look(0);
        bell.silence();
        wrong();
        wrong("SILENT", AlarmBell.Ring.ALARM);
        assertEquals(AlarmBell.Ring.ALARM, bell.look(300));
    }

    @Test
    public void aClockThatBeginsAnewSilencesNothing() {
        wrong("SILENT", AlarmBell.Ring.ALARM);
        assertEquals(AlarmBell.Ring.ALARM, bell.look(1000000));
        assertEquals(AlarmBell.Ring.ALARM, bell.look(5));
    }

    @Test
    public void aSilenceOutlivesARotation() {
        wrong("SILENT", AlarmBell.Ring.ALARM);
        bell.silence();
        AlarmBell other = new AlarmBell();
        other.restore(bell.silenced());
        Map<String, AlarmBell.Ring> loud = new HashMap<>();
        loud.put("SILENT", AlarmBell.Ring.ALARM);
        other.take(loud);
        assertEquals(AlarmBell.Ring.NONE, other.look(0));
    }
}
