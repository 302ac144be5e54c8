"""The MSP cog: a Betaflight board in place of the Arduino."""
