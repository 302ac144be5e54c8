package org.raspilot.up.wire;

/** Makes received texts safe to display. */
public final class SafeText {
    private static final int MAX_MARKS = 2;
    private static final char CUT = '\u2026';

    private SafeText() {
    }

    /**
     * Returns a text of at most {@code limit} characters, at least 1, in one line.
     *
     * <p>Control characters, direction overrides, invisible characters, lone surrogates and
     * excessive combining marks are left out; a truncated text ends in "…".
     */
    public static String of(String text, int limit) {
        final StringBuilder shown = new StringBuilder();
        int marks = 0;
        int place = 0;
        while (place < text.length()) {
            final int letter = text.codePointAt(place);
            place += Character.charCount(letter);
            if (isSpace(letter)) {
                shown.append(' ');
                marks = 0;
            } else if (isMark(letter)) {
                marks++;
                if (marks <= MAX_MARKS && shown.length() > 0) {
                    shown.appendCodePoint(letter);
                }
            } else if (isShown(letter)) {
                shown.appendCodePoint(letter);
                marks = 0;
            }
            if (shown.length() > limit) {
                return cut(shown, limit);
            }
        }
        return shown.toString();
    }

    private static String cut(StringBuilder shown, int limit) {
        int end = limit - 1;
        if (end > 0 && Character.isHighSurrogate(shown.charAt(end - 1))) {
            end--;
        }
        return shown.substring(0, end) + CUT;
    }

    private static boolean isSpace(int letter) {
        return letter == '\t' || letter == '\n' || letter == '\r' || Character.isSpaceChar(letter);
    }

    private static boolean isMark(int letter) {
        final int type = Character.getType(letter);
        return type == Character.NON_SPACING_MARK || type == Character.ENCLOSING_MARK
                || type == Character.COMBINING_SPACING_MARK;
    }

    private static boolean isShown(int letter) {
        final int type = Character.getType(letter);
        return type != Character.CONTROL && type != Character.FORMAT
                && type != Character.SURROGATE && type != Character.PRIVATE_USE
                && type != Character.UNASSIGNED;
    }
}
