package org.raspilot.up.virtual_phone;

/** Reads the values of options; each raises OptionException with a sentence. */
final class OptionParser {
    private static final int MAX_PORT = 65535;

    private OptionParser() {}

    /** Splits at the last colons: the part before them may contain colons too. */
    static String[] parts(String name, String value, int count, String form)
            throws OptionException {
        String[] found = new String[count];
        String rest = value;
        for (int at = count - 1; at > 0; at--) {
            int colon = rest.lastIndexOf(':');
            if (colon <= 0) {
                throw new OptionException(name + " '" + value + "' is not " + form);
            }
            found[at] = rest.substring(colon + 1);
            rest = rest.substring(0, colon);
        }
        found[0] = rest;
        return found;
    }

    /** Returns a port, 1 to 65535. */
    static int port(String name, String value) throws OptionException {
        return (int) number(name + ": a port", value, 1, MAX_PORT);
    }

    /** Returns a whole number in its range. */
    static long number(String what, String value, long least, long most) throws OptionException {
        try {
            long found = Long.parseLong(value);
            if (found >= least && found <= most) {
                return found;
            }
        } catch (NumberFormatException error) {
            throw outOfRange(what, value, least, most);
        }
        throw outOfRange(what, value, least, most);
    }

    /** Returns the exception for an unknown option, or one without a value. */
    static OptionException unknown(String name, boolean isLast) {
        String why = isLast ? ": no such option, or its value is missing" : ": no such option";
        return new OptionException(name + why + "; see --help");
    }

    private static OptionException outOfRange(String what, String value, long least, long most) {
        return new OptionException(what + " is " + least + " to " + most + ", not '" + value + "'");
    }

    /** Invalid input of a program: one sentence for the user. */
    static final class OptionException extends Exception {
        private static final long serialVersionUID = 1;

        OptionException(String sentence) {
            super(sentence);
        }
    }
}
