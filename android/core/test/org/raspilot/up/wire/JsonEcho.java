package org.raspilot.up.wire;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStreamReader;
import java.io.PrintStream;
import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.commands.CommandRegistry;
import org.raspilot.up.commands.InvalidCommandException;

/**
 * Prints how the core parses lines, for {@code tests/android/test_json_agrees.py}.
 *
 * <p>Each line of stdin is the bytes of a General Message line in hex. Each line of stdout is an
 * object: {@code line}, the message written again (null: it would be too long), and {@code
 * invalid}, the code of the Command's error (null: valid); or {@code malformed}, the code,
 * and {@code id}.
 */
public final class JsonEcho {
    private JsonEcho() {
    }

    public static void main(String[] arguments) throws IOException {
        CommandRegistry registry = CommandRegistry.builtin();
        BufferedReader in = new BufferedReader(new InputStreamReader(System.in, "US-ASCII"));
        PrintStream out = new PrintStream(System.out, false, "US-ASCII");
        for (String hex = in.readLine(); hex != null; hex = in.readLine()) {
            out.print(Json.write(answer(bytes(hex), registry)) + "\n");
            out.flush();
        }
    }

    private static Map<String, Object> answer(byte[] line, CommandRegistry registry) {
        Map<String, Object> answer = new LinkedHashMap<>();
        try {
            GeneralMessage message = GeneralMessage.read(line, line.length);
            answer.put("line", written(message));
            answer.put("invalid", complaint(message, registry));
        } catch (MalformedException fault) {
            answer.put("malformed", fault.code);
            answer.put("id", fault.id);
        }
        return answer;
    }

    private static String written(GeneralMessage message) {
        try {
            return Vectors.text(message.toLine());
        } catch (IllegalArgumentException tooLong) {
            return null;
        }
    }

    private static String complaint(GeneralMessage message, CommandRegistry registry) {
        try {
            registry.read(message);
            return null;
        } catch (InvalidCommandException fault) {
            return fault.code;
        }
    }

    private static byte[] bytes(String hex) {
        byte[] bytes = new byte[hex.length() / 2];
        for (int i = 0; i < bytes.length; i++) {
            bytes[i] = (byte) Integer.parseInt(hex.substring(2 * i, 2 * i + 2), 16);
        }
        return bytes;
    }
}
