package org.raspilot.up.wire;

import java.nio.ByteBuffer;
import java.nio.charset.CharacterCodingException;
import java.nio.charset.Charset;
import java.nio.charset.CodingErrorAction;

/** Text as the bytes of a line. */
final class Utf8 {
    private static final Charset UTF_8 = Charset.forName("UTF-8");

    private Utf8() {
    }

    /** Returns the text of the first {@code length} bytes; throws for invalid UTF-8. */
    static String decode(byte[] bytes, int length) throws MalformedException {
        try {
            return UTF_8.newDecoder()
                    .onMalformedInput(CodingErrorAction.REPORT)
                    .onUnmappableCharacter(CodingErrorAction.REPORT)
                    .decode(ByteBuffer.wrap(bytes, 0, length))
                    .toString();
        } catch (CharacterCodingException fault) {
            throw new MalformedException("not_utf8", "not UTF-8");
        }
    }

    /** Returns printable ASCII, or null if there are other bytes. */
    static String printableAscii(byte[] bytes, int length) {
        StringBuilder text = new StringBuilder(length);
        for (int i = 0; i < length; i++) {
            if (bytes[i] < ' ' || bytes[i] > '~') {
                return null;
            }
            text.append((char) bytes[i]);
        }
        return text.toString();
    }

    static byte[] encode(String text) {
        return text.getBytes(UTF_8);
    }
}
