"""The virtual aircraft: a flight dynamics model behind a stand-in board and a stand-in phone.

Nothing here imports the daemon: the codecs are written from the byte tables of
``docs/protocols.md``, so that two readings of that page meet on the wire.
"""
