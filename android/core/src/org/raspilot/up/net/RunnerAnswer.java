package org.raspilot.up.net;

import java.util.Map;
import org.raspilot.up.wire.Json;
import org.raspilot.up.wire.MalformedException;
import org.raspilot.up.wire.SafeText;

/** A runner's answer with the address of an instance (protocols 8). */
public final class RunnerAnswer {
    private static final int MAX_TEXT_LENGTH = 200;

    /** The runner's message; null: none. */
    public final String message;
    /** A warning about the running instance, or null. */
    public final String error;
    public final Endpoint endpoint;
    /** The proxy's host for grounds of this aircraft; null: absent. */
    public final String proxyHost;
    /** The proxy's port for grounds; 0: absent. */
    public final int proxyGroundPort;

    private RunnerAnswer(Map<?, ?> answer, Endpoint place, Map<?, ?> proxy) {
        this.endpoint = place;
        message = text(answer, "message");
        error = text(answer, "error");
        proxyGroundPort = proxy == null ? 0 : port(proxy, "ground");
        proxyHost = proxyGroundPort == 0 ? null : text(proxy, "host");
    }

    /**
     * Parses a line of an answer.
     *
     * @param runnerHost the runner's host, where the instance listens unless the answer names
     *     another one
     * @throws RefusedException with a sentence when no instance runs or the line is not an answer
     */
    static RunnerAnswer read(String line, String runnerHost) throws RefusedException {
        final Map<?, ?> answer = parse(line);
        final Object isRunning = answer.get("running");
        if (!(isRunning instanceof Boolean)) {
            throw notUnderstood("running is neither true nor false");
        }
        if (!(Boolean) isRunning) {
            final String error = text(answer, "error");
            final String message = text(answer, "message");
            final String code = text(answer, "code");
            throw new RefusedException(code != null ? code : "refused", "the runner says: "
                    + (error != null ? error : message != null ? message : "nothing runs"));
        }
        final Map<?, ?> ports = object(answer, "ports");
        final int general = ports == null ? 0 : port(ports, "general");
        final int orientation = ports == null ? 0 : port(ports, "orientation");
        if (general == 0 || orientation == 0) {
            throw new RefusedException("no_ports",
                    "the runner's answer names no ports of 1 to 65535");
        }
        final String named = text(answer, "host");
        final String host = named == null ? runnerHost : named;
        return new RunnerAnswer(answer, new Endpoint(host, general, orientation),
                object(answer, "proxy"));
    }

    private static Map<?, ?> parse(String line) throws RefusedException {
        try {
            final Object value = Json.parse(line);
            if (value instanceof Map) {
                return (Map<?, ?>) value;
            }
            throw notUnderstood("no object");
        } catch (MalformedException malformed) {
            throw notUnderstood(malformed.reason());
        }
    }

    private static RefusedException notUnderstood(String why) {
        return new RefusedException("not_understood",
                "the runner's answer is not understood: " + why);
    }

    private static Map<?, ?> object(Map<?, ?> from, String key) {
        final Object value = from.get(key);
        return value instanceof Map ? (Map<?, ?>) value : null;
    }

    /** Returns a text, safe to display, or null if absent. */
    private static String text(Map<?, ?> from, String key) {
        final Object value = from.get(key);
        if (!(value instanceof String) || ((String) value).isEmpty()) {
            return null;
        }
        return SafeText.of((String) value, MAX_TEXT_LENGTH);
    }

    /** Returns 1 to 65535; 0: absent. */
    private static int port(Map<?, ?> from, String key) {
        final Object value = from.get(key);
        if (!(value instanceof Long)) {
            return 0;
        }
        final long port = (Long) value;
        return port >= 1 && port <= 65535 ? (int) port : 0;
    }

    /** No place is to be had; the message is a sentence without a full stop. */
    static final class RefusedException extends Exception {
        private static final long serialVersionUID = 1L;
        /** {@code refused no_ports not_understood}, or the runner's. */
        final String code;

        RefusedException(String code, String sentence) {
            super(sentence);
            this.code = code;
        }
    }
}
