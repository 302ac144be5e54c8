"""What Betaflight 2026.12 (SITL, mixer AIRPLANE) answered, disarmed and level, in ANGLE."""

from msp_cog import messages

ANSWERS = {
    number: bytes.fromhex(payload)
    for number, payload in {
        messages.VARIANT: "4254464c",
        messages.VERSION: "1a0c000f323032362e31322e302d616c706861",
        messages.RECEIVER_MAP: "0001030204050607",
        messages.RC_TUNING: "07004343430032000000000707000064ce07ce07ce070332",
        messages.DEADBAND: "0000003200",
        messages.ADVANCED: "00000000000000000000000000000000003c000000500000000000010100050078007d"
        "00780000282e00002300000f64000001410f5a07000001414605",
        messages.BOX_IDS: "0001020503060c1b0b38070d131a1e20212224252d32333435",
        messages.RC: "400640060e06e803dc05d007e803e803e803e803dc05dc05dc05dc05dc05dc05",
        messages.RAW_IMU: "0000000000010000ffffffff480a8cfb94f4",
        messages.ATTITUDE: "2c01cdff2800",
        messages.STATUS: "d60300002f00020000000000000400001e00000000000000040300",
        messages.SERVO: "dc05dc05dc0550065006dc0549061f04",
        messages.MOTOR: "1f040000000000000000000000000000",
        messages.RAW_GPS: "020c873be01db106cd0872017705c1010a00",
        messages.ANALOG: "000000000000000000",
    }.items()
}
"""The attitude is changed to 30, 5.1 (nose up) and 40 degrees."""
STREAM = bytes.fromhex(
    "244d3e04024254464c1a244d3e13031a0c000f323032362e31322e302d616c70686165244d3e0840000103020405060748"
)
"""The first three answers on the line."""
ARMED, ANGLE, OVERRIDE = 1 << 0, 1 << 1, 1 << 21
"""Bits of the status, by the ids of the boxes."""
RECEIVER_FAILSAFE = 1 << 2


def status(boxes=ANGLE, reasons=0):
    """Return the answer with other active boxes, and other reasons against arming."""
    plain = ANSWERS[messages.STATUS]
    before, after = plain[:6], plain[10:17]
    return before + boxes.to_bytes(4, "little") + after + reasons.to_bytes(4, "little")
