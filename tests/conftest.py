"""What holds for every test."""

import signal

# A shell that starts something in the background lets it ignore Ctrl-C, and every program that it
# starts as well: then none of the tests' own programs would end by it.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
