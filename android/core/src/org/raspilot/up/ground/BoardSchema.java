package org.raspilot.up.ground;

import java.util.Arrays;
import java.util.Collections;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/** Tables of the board's status.
 *  Generated from schema/status.yml by tools/schema.py; do not edit. */
final class BoardSchema {
    /** Time for which an alarm outlasts its condition, ms. */
    static final long ALARM_HOLD_MS = 2000;
    /** Events and alarms. */
    static final List<BoardAlarm> ALARMS = Collections.unmodifiableList(Arrays.asList(
            new BoardAlarm("receiver", "failsafe", Alarm.Kind.RECEIVER,
                    "arduino.receiver_valid", Boolean.FALSE, 0.0, "arduino.failsafe",
                    EventLevel.WARNING, EventLevel.ALARM,
                    "the receiver is lost",
                    "the receiver is back", 2000),
            new BoardAlarm("imu", "source", Alarm.Kind.IMU,
                    "arduino.imu_valid", Boolean.FALSE, 0.0, "",
                    EventLevel.ALARM, EventLevel.ALARM,
                    "the IMU is invalid: nothing stabilises",
                    "the IMU is valid", 2000),
            new BoardAlarm("failsafe", "failsafe", Alarm.Kind.FAILSAFE,
                    "arduino.failsafe", Boolean.TRUE, 0.0, "",
                    EventLevel.ALARM, EventLevel.ALARM,
                    "failsafe: the board flies without a receiver",
                    "the failsafe is over", 2000),
            new BoardAlarm("restored", "source", null,
                    "arduino.restored", Boolean.TRUE, 0.0, "",
                    EventLevel.ALARM, EventLevel.ALARM,
                    "the board was reset in flight and continues as before",
                    "", 2000)));
    /** Units by path in telemetry. */
    static final Map<String, String> UNITS = new HashMap<String, String>();

    static {
        UNITS.put("arduino.loop_us", "us");
        UNITS.put("arduino.late_us", "us");
    }

    private BoardSchema() {
    }
}
