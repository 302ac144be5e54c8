package org.raspilot.app.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;

import java.util.HashMap;
import java.util.Map;
import org.junit.Test;
import org.raspilot.up.ground.EventLevel;

public final class AlarmBellTest {
    private final AlarmBell bell = new AlarmBell();

    private void wrong(Object... kindsAndRings) {
        Map<String, EventLevel> loud = new HashMap<>();
        for (int each = 0; each < kindsAndRings.length; each += 2) {
            loud.put((String) kindsAndRings[each], (EventLevel) kindsAndRings[each + 1]);
        }
        bell.update(loud);
    }

    @Test
    public void withoutACauseNothingSounds() {
        wrong();
        assertNull(bell.ringAt(0));
        assertFalse(bell.isRinging());
    }

    @Test
    public void anAlarmSoundsAtOnceAndEachTwoSeconds() {
        wrong("SILENT", EventLevel.ALARM);
        assertEquals(EventLevel.ALARM, bell.ringAt(5000));
        assertNull(bell.ringAt(6999));
        assertEquals(EventLevel.ALARM, bell.ringAt(7000));
    }

    @Test
    public void aWarningIsRepeatedSeldom() {
        wrong("PHONE", EventLevel.WARNING);
        assertEquals(EventLevel.WARNING, bell.ringAt(0));
        assertNull(bell.ringAt(9999));
        assertEquals(EventLevel.WARNING, bell.ringAt(10000));
    }

    @Test
    public void whatIsNewSoundsAtOnceBesideWhatSoundsAlready() {
        wrong("PHONE", EventLevel.WARNING);
        bell.ringAt(0);
        wrong("PHONE", EventLevel.WARNING, "BATTERY", EventLevel.WARNING);
        assertEquals(EventLevel.WARNING, bell.ringAt(100));
        wrong("PHONE", EventLevel.WARNING, "BATTERY", EventLevel.ALARM);
        assertEquals(EventLevel.ALARM, bell.ringAt(200));
    }

    @Test
    public void whatIsSilencedStaysSoWhileItLasts() {
        wrong("SILENT", EventLevel.ALARM);
        bell.ringAt(0);
        bell.silence();
        assertNull(bell.ringAt(60000));
        assertFalse(bell.isRinging());
        assertEquals(1, bell.silenced().length);
    }

    @Test
    public void anotherAlarmSoundsThroughTheSilence() {
        wrong("SILENT", EventLevel.ALARM);
        bell.ringAt(0);
        bell.silence();
        wrong("SILENT", EventLevel.ALARM, "BOARD", EventLevel.ALARM);
        assertEquals(EventLevel.ALARM, bell.ringAt(100));
    }

    @Test
    public void aWarningThatBecomesAnAlarmSoundsAgain() {
        wrong("RECEIVER", EventLevel.WARNING);
        bell.silence();
        wrong("RECEIVER", EventLevel.ALARM);
        assertEquals(EventLevel.ALARM, bell.ringAt(100));
    }

    @Test
    public void whatComesBackSoundsAgain() {
        wrong("SILENT", EventLevel.ALARM);
        bell.ringAt(0);
        bell.silence();
        wrong();
        wrong("SILENT", EventLevel.ALARM);
        assertEquals(EventLevel.ALARM, bell.ringAt(300));
    }

    @Test
    public void aClockThatBeginsAnewSilencesNothing() {
        wrong("SILENT", EventLevel.ALARM);
        assertEquals(EventLevel.ALARM, bell.ringAt(1000000));
        assertEquals(EventLevel.ALARM, bell.ringAt(5));
    }

    @Test
    public void aSilenceOutlivesARotation() {
        wrong("SILENT", EventLevel.ALARM);
        bell.silence();
        AlarmBell other = new AlarmBell();
        other.restore(bell.silenced());
        Map<String, EventLevel> loud = new HashMap<>();
        loud.put("SILENT", EventLevel.ALARM);
        other.update(loud);
        assertNull(other.ringAt(0));
    }
}
