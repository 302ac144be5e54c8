"""A CRSF receiver (ExpressLRS, Crossfire), for Up."""
