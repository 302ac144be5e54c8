package org.raspilot.app.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;

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
        bell.update(loud);
    }

    @Test
    public void withoutACauseNothingSounds() {
        wrong();
        assertEquals(AlarmBell.Ring.NONE, bell.ringAt(0));
        assertFalse(bell.isRinging());
    }

    @Test
    public void anAlarmSoundsAtOnceAndEachTwoSeconds() {
        wrong("SILENT", AlarmBell.Ring.ALARM);
        assertEquals(AlarmBell.Ring.ALARM, bell.ringAt(5000));
        assertEquals(AlarmBell.Ring.NONE, bell.ringAt(6999));
        assertEquals(AlarmBell.Ring.ALARM, bell.ringAt(7000));
    }

    @Test
    public void aWarningIsRepeatedSeldom() {
        wrong("PHONE", AlarmBell.Ring.WARNING);
        assertEquals(AlarmBell.Ring.WARNING, bell.ringAt(0));
        assertEquals(AlarmBell.Ring.NONE, bell.ringAt(9999));
        assertEquals(AlarmBell.Ring.WARNING, bell.ringAt(10000));
    }

    @Test
    public void whatIsNewSoundsAtOnceBesideWhatSoundsAlready() {
        wrong("PHONE", AlarmBell.Ring.WARNING);
        bell.ringAt(0);
        wrong("PHONE", AlarmBell.Ring.WARNING, "BATTERY", AlarmBell.Ring.WARNING);
        assertEquals(AlarmBell.Ring.WARNING, bell.ringAt(100));
        wrong("PHONE", AlarmBell.Ring.WARNING, "BATTERY", AlarmBell.Ring.ALARM);
        assertEquals(AlarmBell.Ring.ALARM, bell.ringAt(200));
    }

    @Test
    public void whatIsSilencedStaysSoWhileItLasts() {
        wrong("SILENT", AlarmBell.Ring.ALARM);
        bell.ringAt(0);
        bell.silence();
        assertEquals(AlarmBell.Ring.NONE, bell.ringAt(60000));
        assertFalse(bell.isRinging());
        assertEquals(1, bell.silenced().length);
    }

    @Test
    public void anotherAlarmSoundsThroughTheSilence() {
        wrong("SILENT", AlarmBell.Ring.ALARM);
        bell.ringAt(0);
        bell.silence();
        wrong("SILENT", AlarmBell.Ring.ALARM, "BOARD", AlarmBell.Ring.ALARM);
        assertEquals(AlarmBell.Ring.ALARM, bell.ringAt(100));
    }

    @Test
    public void aWarningThatBecomesAnAlarmSoundsAgain() {
        wrong("RECEIVER", AlarmBell.Ring.WARNING);
        bell.silence();
        wrong("RECEIVER", AlarmBell.Ring.ALARM);
        assertEquals(AlarmBell.Ring.ALARM, bell.ringAt(100));
    }

    @Test
    public void whatComesBackSoundsAgain() {
        wrong("SILENT", AlarmBell.Ring.ALARM);
        bell.ringAt(0);
        bell.silence();
        wrong();
        wrong("SILENT", AlarmBell.Ring.ALARM);
        assertEquals(AlarmBell.Ring.ALARM, bell.ringAt(300));
    }

    @Test
    public void aClockThatBeginsAnewSilencesNothing() {
        wrong("SILENT", AlarmBell.Ring.ALARM);
        assertEquals(AlarmBell.Ring.ALARM, bell.ringAt(1000000));
        assertEquals(AlarmBell.Ring.ALARM, bell.ringAt(5));
    }

    @Test
    public void aSilenceOutlivesARotation() {
        wrong("SILENT", AlarmBell.Ring.ALARM);
        bell.silence();
        AlarmBell other = new AlarmBell();
        other.restore(bell.silenced());
        Map<String, AlarmBell.Ring> loud = new HashMap<>();
        loud.put("SILENT", AlarmBell.Ring.ALARM);
        other.update(loud);
        assertEquals(AlarmBell.Ring.NONE, other.ringAt(0));
    }
}
