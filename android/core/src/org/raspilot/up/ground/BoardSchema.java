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
            new BoardAlarm(Alarm.Kind.RECEIVER, true,
                    "arduino.receiver_valid", Boolean.FALSE, 0.0, "arduino.failsafe",
                    EventLevel.WARNING, EventLevel.ALARM,
                    "receiver_lost", "the receiver is lost",
                    "receiver_back", "the receiver is back", 2000),
            new BoardAlarm(Alarm.Kind.IMU, true,
                    "arduino.imu_valid", Boolean.FALSE, 0.0, "",
                    EventLevel.ALARM, EventLevel.ALARM,
                    "imu_invalid", "the IMU is invalid: no stabilisation",
                    "imu_valid", "the IMU is valid", 2000),
            new BoardAlarm(Alarm.Kind.FAILSAFE, true,
                    "arduino.failsafe", Boolean.TRUE, 0.0, "",
                    EventLevel.ALARM, EventLevel.ALARM,
                    "failsafe", "failsafe: the Arduino flies without a receiver",
                    "failsafe_over", "the failsafe is over", 2000),
            new BoardAlarm(null, true,
                    "arduino.restored", Boolean.TRUE, 0.0, "",
                    EventLevel.ALARM, EventLevel.ALARM,
                    "board_reset", "the Arduino was reset in flight and restored its state",
                    "board_reset_over", "", 2000)));
    /** Units by path in telemetry. */
    static final Map<String, String> UNITS = new HashMap<String, String>();

    static {
        UNITS.put("arduino.loop_us", "us");
        UNITS.put("arduino.late_us", "us");
    }

    private BoardSchema() {
    }
}
