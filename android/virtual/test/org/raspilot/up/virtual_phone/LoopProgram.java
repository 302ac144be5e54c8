package org.raspilot.up.virtual_phone;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStream;
import java.io.InputStreamReader;
import java.nio.charset.Charset;
import java.util.Map;
import java.util.concurrent.CountDownLatch;
import org.raspilot.up.loop.FaultListener;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.loop.SelectorLoop;
import org.raspilot.up.virtual_phone.OptionParser.OptionException;
import org.raspilot.up.wire.Json;
import org.raspilot.up.wire.MalformedException;

/** A program in real time with its own sockets: it runs until its standard input ends. */
final class LoopProgram implements FaultListener {
    /** A process that closes standard input may give the JVM some other file in its place. */
    private static final int MAX_WRONG = 100;

    private final EventWriter words;
    private final SelectorLoop loop;

    /** What it consists of; all calls come on the loop. */
    interface Part {
        void start(Loop loop);

        /**
         * Takes a line.
         *
         * @throws OptionException when it is invalid (a sentence, which is printed)
         */
        void onLine(Map<?, ?> line) throws OptionException;

        void stop();
    }

    LoopProgram(String name, EventWriter words) {
        this.words = words;
        loop = new SelectorLoop(name, this);
    }

    /** Runs a part until input ends, or a hundred lines in a row are invalid. */
    void run(InputStream input, final Part part) throws IOException {
        loop.start();
        loop.post(() -> part.start(loop));
        BufferedReader lines =
                new BufferedReader(new InputStreamReader(input, Charset.forName("UTF-8")));
        String text = lines.readLine();
        for (int wrong = 0; text != null && wrong < MAX_WRONG; text = lines.readLine()) {
            try {
                handle(part, parse(text));
                wrong = 0;
            } catch (OptionException error) {
                words.notice(error.code, error.getMessage());
                wrong++;
            }
        }
        if (text != null) {
            words.notice("input_ended",
                    MAX_WRONG + " lines in a row are not JSON objects: giving up");
        }
        end(part);
    }

    @Override
    public void onFault(Throwable fault) {
        words.fault(fault);
    }

    private void handle(Part part, Map<?, ?> line) {
        loop.post(() -> {
            try {
                part.onLine(line);
            } catch (OptionException error) {
                words.notice(error.code, error.getMessage());
            }
        });
    }

    private static Map<?, ?> parse(String text) throws OptionException {
        try {
            Object value = Json.parse(text);
            if (value instanceof Map) {
                return (Map<?, ?>) value;
            }
        } catch (MalformedException error) {
            throw new OptionException("a line is not JSON: " + error.getMessage());
        }
        throw new OptionException("a line must be a JSON object");
    }

    private void end(final Part part) {
        final CountDownLatch isOver = new CountDownLatch(1);
        loop.post(() -> {
            try {
                part.stop();
            } finally {
                isOver.countDown();
            }
        });
        try {
            isOver.await();
        } catch (InterruptedException error) {
            Thread.currentThread().interrupt();
        }
        loop.stop();
    }
}
