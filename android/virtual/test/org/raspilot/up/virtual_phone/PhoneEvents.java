package org.raspilot.up.virtual_phone;

import java.util.Map;
import org.raspilot.up.airborne.AirborneListener;
import org.raspilot.up.airborne.AirborneStatus;
import org.raspilot.up.airborne.Speaker;
import org.raspilot.up.loop.FaultListener;
import org.raspilot.up.net.Endpoint;

/** Prints the events of the airborne side as lines. */
final class PhoneEvents implements AirborneListener, Speaker, FaultListener {
    private final EventWriter words;

    PhoneEvents(EventWriter words) {
        this.words = words;
    }

    @Override
    public void onConnected(Endpoint place) {
        Map<String, Object> event = EventWriter.event("connected", "host", place.host);
        event.put("general", (long) place.generalPort);
        event.put("orientation", (long) place.orientationPort);
        words.write(event);
    }

    @Override
    public void onDisconnected(String code, String reason) {
        Map<String, Object> event = EventWriter.event("lost", "code", code);
        event.put("reason", reason);
        words.write(event);
    }

    @Override
    public void onPanic(long delayMs) {
        words.write(EventWriter.event("panic", "delay_ms", delayMs));
    }

    @Override
    public void onEvent(String code, String sentence) {
        words.notice(code, sentence);
    }

    @Override
    public void speak(String text) {
        words.write(EventWriter.event("says", "text", text));
    }

    @Override
    public void onFault(Throwable fault) {
        words.fault(fault);
    }

    void counters(AirborneStatus status) {
        Map<String, Object> event =
                EventWriter.event("counters", "connections", status.counters.connections);
        event.put("telemetry", status.counters.telemetry);
        event.put("executed", status.counters.executed);
        event.put("refused", status.counters.refused);
        event.put("malformed", status.counters.malformed);
        words.write(event);
    }
}
