"""The virtual aircraft: a flight dynamics model, the firmware and a phone.

The codecs of the messages are written from the byte tables of ``docs/protocols.md`` and do not
import the daemon's: two readings of that page meet on the wire.
"""
