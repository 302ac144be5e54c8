package org.raspilot.up.virtual_phone;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStream;
import java.io.InputStreamReader;
import java.nio.charset.Charset;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.raspilot.up.loop.ManualLoop;
import org.raspilot.up.virtual_phone.OptionParser.OptionException;

/** The phone in the simulator's time, with the simulator's network: one answer a line. */
final class SteppedRun {
    private final LoopProgram.Part phone;
    private final EventWriter words;
    private final PipedNetwork network = new PipedNetwork();
    private final ManualLoop loop;
    private boolean isStarted;

    /** Takes the phone; the first line starts it. */
    SteppedRun(LoopProgram.Part phone, final EventWriter words) {
        this.phone = phone;
        this.words = words;
        loop = new ManualLoop(network, fault -> words.fault(fault));
    }

    /** Answers every line until the input ends. */
    void run(InputStream input) throws IOException {
        BufferedReader lines =
                new BufferedReader(new InputStreamReader(input, Charset.forName("UTF-8")));
        for (String text = lines.readLine(); text != null; text = lines.readLine()) {
            try {
                step(InputLine.read(text));
            } catch (OptionException error) {
                words.notice("invalid_input", error.getMessage());
            }
            loop.advance(0);
            answer();
        }
        if (isStarted) {
            phone.stop();
        }
        words.flush();
    }

    private void step(final InputLine line) throws OptionException {
        long stepMs = line.timeMs() - loop.nowMs();
        if (stepMs < 0) {
            throw new OptionException("time went back by " + -stepMs + " ms");
        }
        loop.advance(stepMs);
        if (!isStarted) {
            isStarted = true;
            loop.post(() -> phone.start(loop));
        }
        loop.post(() -> {
            try {
                phone.onLine(line.fields);
            } catch (OptionException error) {
                words.notice("invalid_input", error.getMessage());
            }
        });
        List<?> brought = line.network();
        if (brought != null) {
            network.deliver(loop, brought);
        }
    }

    private void answer() {
        long dueMs = loop.nextDueMs();
        Map<String, Object> answer = new LinkedHashMap<>();
        answer.put("due", dueMs < 0 ? null : (Object) dueMs);
        answer.put("net", network.takeRequests());
        words.write(answer);
        words.flush();
    }
}
