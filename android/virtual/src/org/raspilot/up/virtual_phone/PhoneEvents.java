package org.raspilot.up.virtual_phone;

import java.util.Map;
import org.raspilot.up.airborne.AirborneListener;
import org.raspilot.up.airborne.AirborneStatus;
import org.raspilot.up.airborne.Speaker;
import org.raspilot.up.loop.FaultListener;
import org.raspilot.up.net.Place;

/** Prints the events of the airborne side as lines. */
final class PhoneEvents implements AirborneListener, Speaker, FaultListener {
    private final Words words;

    /** Prints events through {@code words}. */
    PhoneEvents(Words words) {
        this.words = words;
    }

    @Override
    public void onConnected(Place place) {
        Map<String, Object> event = Words.event("connected", "host", place.host);
        event.put("general", (long) place.generalPort);
        event.put("orientation", (long) place.orientationPort);
        words.say(event);
    }

    @Override
    public void onDisconnected(String reason) {
        words.say(Words.event("lost", "reason", reason));
    }

    @Override
    public void onPanic(long delayMs) {
        words.say(Words.event("panic", "delay_ms", delayMs));
    }

    @Override
    public void onEvent(String sentence) {
        words.notice(sentence);
    }

    @Override
    public void speak(String text) {
        words.say(Words.event("says", "text", text));
    }

    @Override
    public void onFault(Throwable fault) {
        words.notice(Words.faultText(fault));
    }

    void counters(AirborneStatus status) {
        Map<String, Object> event = Words.event("counters", "connections", status.connections());
        event.put("telemetry", status.telemetry());
        event.put("executed", status.executed());
        event.put("refused", status.refused());
        event.put("malformed", status.malformed());
        words.say(event);
    }
}
