package org.raspilot.up.wire;

import java.io.DataInputStream;
import java.io.File;
import java.io.FileInputStream;
import java.io.IOException;
import java.nio.charset.Charset;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

/** The golden vectors, which the Python and the C++ tests read too. */
public final class Vectors {
    private static final Charset UTF_8 = Charset.forName("UTF-8");

    private Vectors() {
    }

    /** Returns the vectors of a file below the folder that the property {@code vectors} names. */
    @SuppressWarnings("unchecked")
    public static List<Map<String, Object>> read(String name) throws Exception {
        Map<String, Object> file = (Map<String, Object>) Json.parse(
                text(new File(System.getProperty("vectors"), name)));
        List<Map<String, Object>> vectors = new ArrayList<>();
        for (Object vector : (List<Object>) file.get("vectors")) {
            vectors.add((Map<String, Object>) vector);
        }
        return vectors;
    }

    /** Returns the text of a file. */
    public static String text(File file) throws IOException {
        byte[] content = new byte[(int) file.length()];
        DataInputStream in = new DataInputStream(new FileInputStream(file));
        try {
            in.readFully(content);
        } finally {
            in.close();
        }
        return new String(content, UTF_8);
    }

    /** Returns the bytes of a text. */
    public static byte[] bytes(String text) {
        return text.getBytes(UTF_8);
    }

    /** Returns the text of bytes. */
    public static String text(byte[] bytes) {
        return new String(bytes, UTF_8);
    }
}
