package org.raspilot.up.wire;

import static org.junit.Assert.assertEquals;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Random;
import org.junit.Test;

public final class LineSplitterTest {
    private static final long SEED = 77L;

    @Test
    public void linesEndAtLfAndACarriageReturnIsTolerated() {
        assertEquals(Arrays.asList("a", "b\rc", "d\r"),
                feed(new LineSplitter(), "a\nb\rc\r\nd\r\r\n"));
    }

    @Test
    public void emptyLinesAreHeartbeats() {
        assertEquals(Arrays.asList("a"), feed(new LineSplitter(), "\n\r\na\n\n"));
    }

    @Test
    public void halvesAreJoined() {
        LineSplitter splitter = new LineSplitter();
        assertEquals(Arrays.asList(), feed(splitter, "ab"));
        assertEquals(Arrays.asList(), feed(splitter, "c"));
        assertEquals(Arrays.asList("abcd", "e"), feed(splitter, "d\ne\nf"));
    }

    @Test
    public void aLineThatIsTooLongIsDroppedUpToItsEnd() {
        LineSplitter splitter = new LineSplitter(8);
        assertEquals(Arrays.asList("1234567", "b"), feed(splitter, "1234567\n12345678\nb\n"));
        assertEquals(Arrays.asList(), feed(splitter, "1234"));
        assertEquals(Arrays.asList(), feed(splitter, "56789"));
        assertEquals(Arrays.asList(), feed(splitter, "more"));
        assertEquals(Arrays.asList("c"), feed(splitter, "and its end\nc\n"));
    }

    @Test
    public void halfALineIsNotCarriedOverToAnotherConnection() {
        LineSplitter splitter = new LineSplitter(8);
        feed(splitter, "old");
        splitter.reset();
        assertEquals(Arrays.asList("new"), feed(splitter, "new\n"));
        feed(splitter, "much too long");
        splitter.reset();
        assertEquals(Arrays.asList("new"), feed(splitter, "new\n"));
    }

    @Test
    public void onlyTheGivenLengthCounts() {
        List<byte[]> lines = new LineSplitter().feed(Vectors.bytes("a\nb\n"), 2);
        assertEquals(1, lines.size());
    }

    @Test
    public void howTheBytesArriveDoesNotMatter() {
        System.out.println("seed " + SEED);
        Random random = new Random(SEED);
        for (int i = 0; i < 2000; i++) {
            StringBuilder stream = new StringBuilder();
            for (int j = random.nextInt(60); j > 0; j--) {
                stream.append("ab\r\n".charAt(random.nextInt(4)));
            }
            LineSplitter pieces = new LineSplitter(8);
            List<String> wanted = feed(new LineSplitter(8), stream.toString());
            List<String> got = new ArrayList<>();
            int at = 0;
            while (at < stream.length()) {
                int to = Math.min(stream.length(), at + 1 + random.nextInt(10));
                got.addAll(feed(pieces, stream.substring(at, to)));
                at = to;
            }
            assertEquals(wanted, got);
        }
    }

    private static List<String> feed(LineSplitter splitter, String text) {
        List<String> lines = new ArrayList<>();
        byte[] bytes = Vectors.bytes(text);
        for (byte[] line : splitter.feed(bytes, bytes.length)) {
            lines.add(Vectors.text(line));
        }
        return lines;
    }
}
