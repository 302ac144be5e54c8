package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;

/** The values of a frame whose changes are events. */
final class EventRules {
    static final List<EventRule> ALL = Collections.unmodifiableList(Arrays.asList(
            new Named("flight mode", "mode", "flight_mode", "flight mode", EventLevel.INFO),
            new Named("mode", "mode", "mode", "mode", EventLevel.INFO),
            new Named("switch", "mode", "arduino.switch", "the switch stands at", EventLevel.INFO),
            new Armed(),
            new Flag("failsafe", "failsafe", "arduino.failsafe", true, EventLevel.ALARM,
                    "failsafe: the board flies without a receiver", "the failsafe is over"),
            new Flag("receiver", "failsafe", "arduino.receiver_valid", false, EventLevel.WARNING,
                    "the receiver is lost", "the receiver is back"),
            new Flag("imu", "source", "arduino.imu_valid", false, EventLevel.ALARM,
                    "the IMU is invalid: nothing stabilises", "the IMU is valid"),
            new Flag("restored", "source", "arduino.restored", true, EventLevel.ALARM,
                    "the board was reset in flight and went on as before", null),
            new Part("board", EventLevel.ALARM, "back") {
                @Override
                Object read(Telemetry telemetry) {
                    return board(telemetry);
                }
            },
            new Part("phone", EventLevel.WARNING, "here again") {
                @Override
                Object read(Telemetry telemetry) {
                    return phone(telemetry);
                }
            },
            new EventRule("panic", "panic") {
                @Override
                Object read(Telemetry telemetry) {
                    return BusyState.of(telemetry);
                }

                @Override
                String words(Object before, Object now) {
                    return now instanceof BusyState ? now.toString()
                            : before == null ? null : "Raspberry Pi not busy any more";
                }

                @Override
                EventLevel level(Object before, Object now) {
                    return EventLevel.INFO;
                }
            },
            new Vetoes(),
            new Named("role", "link", "ground.role", "the ground is now", EventLevel.WARNING),
            source("orientation"), source("location"), source("altitude"), source("heading"),
            source("battery")));

    private EventRules() {
    }

    private static EventRule source(String reading) {
        return new Named("source " + reading, "source", "source." + reading,
                reading + " comes from", EventLevel.WARNING);
    }

    /** A text whose change is reported with both values. */
    private static final class Named extends EventRule {
        private final String path;
        private final String what;
        private final EventLevel level;

        Named(String key, String kind, String path, String what, EventLevel level) {
            super(key, kind);
            this.path = path;
            this.what = what;
            this.level = level;
        }

        @Override
        Object read(Telemetry telemetry) {
            return telemetry.text(path);
        }

        @Override
        String words(Object before, Object now) {
            return before == null ? null : what + " " + now + " (was " + before + ")";
        }

        @Override
        EventLevel level(Object before, Object now) {
            return level;
        }
    }

    /** A flag that is reported when it becomes bad, and when it is good again. */
    private static final class Flag extends EventRule {
        private final String path;
        private final Boolean bad;
        private final EventLevel level;
        private final String saidBad;
        private final String saidGood;

        Flag(String key, String kind, String path, boolean bad, EventLevel level, String saidBad,
                String saidGood) {
            super(key, kind);
            this.path = path;
            this.bad = bad;
            this.level = level;
            this.saidBad = saidBad;
            this.saidGood = saidGood;
        }

        @Override
        Object read(Telemetry telemetry) {
            return telemetry.flag(path);
        }

        @Override
        String words(Object before, Object now) {
            if (bad.equals(now)) {
                return saidBad;
            }
            return before == null ? null : saidGood;
        }

        @Override
        EventLevel level(Object before, Object now) {
            return bad.equals(now) ? level : EventLevel.INFO;
        }
    }

    /** A part that may come later than the program, and go. */
    private abstract static class Part extends EventRule {
        private final EventLevel level;
        private final String back;

        Part(String key, EventLevel level, String back) {
            super(key, "link");
            this.level = level;
            this.back = back;
        }

        @Override
        final String words(Object before, Object now) {
            if (isGone(before, now)) {
                return "the " + key + " is gone";
            }
            if (now.equals(NOT_YET)) {
                return before == null ? "the " + key + " is not here yet" : null;
            }
            if (before == null) {
                return null;
            }
            return "the " + key + " is " + (before.equals(NOT_YET) ? "here" : back);
        }

        @Override
        final EventLevel level(Object before, Object now) {
            return isGone(before, now) ? level : EventLevel.INFO;
        }

        private static boolean isGone(Object before, Object now) {
            return Boolean.FALSE.equals(now)
                    || now.equals(NOT_YET) && Boolean.TRUE.equals(before);
        }
    }

    private static final class Armed extends EventRule {
        Armed() {
            super("armed", "armed");
        }

        @Override
        Object read(Telemetry telemetry) {
            return telemetry.flag("armed");
        }

        @Override
        String words(Object before, Object now) {
            final boolean isArmed = Boolean.TRUE.equals(now);
            if (before == null) {
                return isArmed ? "the aircraft is armed" : null;
            }
            return isArmed ? "armed" : "disarmed";
        }

        @Override
        EventLevel level(Object before, Object now) {
            return Boolean.TRUE.equals(now) ? EventLevel.WARNING : EventLevel.INFO;
        }
    }

    /** The arming vetoes; the first element is whether the aircraft is armed. */
    private static final class Vetoes extends EventRule {
        Vetoes() {
            super("vetoes", "veto");
        }

        @Override
        Object read(Telemetry telemetry) {
            final List<String> vetoes = telemetry.texts("vetoes");
            if (vetoes == null) {
                return null;
            }
            final List<String> sorted = new ArrayList<>(vetoes);
            Collections.sort(sorted);
            final boolean isArmed = Boolean.TRUE.equals(telemetry.flag("armed"));
            sorted.add(0, isArmed ? "against arming again: " : "against arming: ");
            return sorted;
        }

        @Override
        String words(Object before, Object now) {
            final List<?> vetoes = rest(now);
            if (before == null ? vetoes.isEmpty() : rest(before).equals(vetoes)) {
                return null;
            }
            if (vetoes.isEmpty()) {
                return "nothing speaks against arming any more";
            }
            final StringBuilder text = new StringBuilder();
            for (Object each : vetoes) {
                text.append(text.length() == 0 ? "" : "; ").append(each);
            }
            return ((List<?>) now).get(0).toString() + text;
        }

        @Override
        EventLevel level(Object before, Object now) {
            return EventLevel.INFO;
        }

        private static List<?> rest(Object value) {
            final List<?> all = (List<?>) value;
            return all.subList(1, all.size());
        }
    }
}
