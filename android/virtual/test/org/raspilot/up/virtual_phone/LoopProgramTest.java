package org.raspilot.up.virtual_phone;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertTrue;

import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.InputStream;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import org.junit.Test;
import org.raspilot.up.loop.Loop;

/** A program in real time runs until its input ends. */
public final class LoopProgramTest {
    private static final int LONG_MS = 20000;

    private final ByteArrayOutputStream said = new ByteArrayOutputStream();
    private final List<String> done = new ArrayList<>();
    private final LoopProgram.Part part = new LoopProgram.Part() {
        @Override
        public void start(Loop loop) {
            done.add("start");
        }

        @Override
        public void onLine(Map<?, ?> line) {
            done.add(line.toString());
        }

        @Override
        public void stop() {
            done.add("stop");
        }
    };

    @Test(timeout = LONG_MS)
    public void itTakesEachLineAndEndsWithTheLast() throws Exception {
        run(new ByteArrayInputStream("{\"a\": 1}\nnonsense\n{\"b\": 2}\n".getBytes("UTF-8")));
        assertEquals("[start, {a=1}, {b=2}, stop]", done.toString());
        assertEquals(1, said.toString("UTF-8").split("invalid_input", -1).length - 1);
    }

    @Test(timeout = LONG_MS)
    public void anInputThatIsNoneOfItsOwnEndsIt() throws Exception {
        run(new InputStream() {
            private int count;

            @Override
            public int read() {
                return count++ % 2 == 0 ? 'x' : '\n';
            }
        });
        assertEquals("[start, stop]", done.toString());
        String told = said.toString("UTF-8");
        assertTrue(told, told.contains("\"input_ended\""));
        assertTrue(told.length() < 100000);
    }

    private void run(InputStream input) throws IOException {
        new LoopProgram("test program", new EventWriter(said)).run(input, part);
    }
}
