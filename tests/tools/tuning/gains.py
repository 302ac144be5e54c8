from tools.tuning.gain_set import ZERO
from up.commands.gains import Gains, GainSet, LoopGains

FIRM = GainSet(
    LoopGains(Gains(6.0), Gains(3.0), Gains(1.0)), LoopGains(Gains(8.0), Gains(6.0), ZERO)
)
"""Fast at cruise, with a roll rate gain that has little left in a dive."""
