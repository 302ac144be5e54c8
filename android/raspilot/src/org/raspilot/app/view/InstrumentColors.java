package org.raspilot.app.view;

import android.content.Context;
import android.content.res.TypedArray;
import org.raspilot.app.R;

/** The colours of the instruments, from the theme's {@code instrumentStyle}; each an ARGB int. */
public final class InstrumentColors {
    public final int ground;
    public final int ink;
    public final int dim;
    public final int line;
    public final int sky;
    public final int earth;
    /** The ladder upon sky and earth. */
    public final int horizonInk;
    public final int accent;
    public final int good;
    /** Stale values, or values that need attention. */
    public final int warning;
    public final int alarm;
    public final int hatch;

    private InstrumentColors(TypedArray has) {
        ground = has.getColor(R.styleable.Instrument_instrumentGround, 0xff000000);
        ink = has.getColor(R.styleable.Instrument_instrumentInk, 0xffffffff);
        dim = has.getColor(R.styleable.Instrument_instrumentDim, 0xffa0a0a0);
        line = has.getColor(R.styleable.Instrument_instrumentLine, 0xff606060);
        sky = has.getColor(R.styleable.Instrument_instrumentSky, 0xff2060a0);
        earth = has.getColor(R.styleable.Instrument_instrumentEarth, 0xff604020);
        horizonInk = has.getColor(R.styleable.Instrument_instrumentHorizonInk, 0xffffffff);
        accent = has.getColor(R.styleable.Instrument_instrumentAccent, 0xff60c0ff);
        good = has.getColor(R.styleable.Instrument_instrumentGood, 0xff60c060);
        warning = has.getColor(R.styleable.Instrument_instrumentWarning, 0xffffb030);
        alarm = has.getColor(R.styleable.Instrument_instrumentAlarm, 0xffff6060);
        hatch = has.getColor(R.styleable.Instrument_instrumentHatch, 0x66ffb030);
    }

    private InstrumentColors(InstrumentColors live) {
        ground = live.ground;
        ink = live.dim;
        dim = live.dim;
        line = live.line;
        sky = ColorMath.between(ColorMath.grey(live.sky), live.ground, 0.4f);
        earth = ColorMath.between(ColorMath.grey(live.earth), live.ground, 0.4f);
        horizonInk = live.dim;
        accent = live.dim;
        good = live.dim;
        warning = live.warning;
        alarm = live.alarm;
        hatch = live.hatch;
    }

    public static InstrumentColors of(Context context) {
        TypedArray has = context.obtainStyledAttributes(null, R.styleable.Instrument,
                R.attr.instrumentStyle, R.style.Instrument_Dark);
        try {
            return new InstrumentColors(has);
        } finally {
            has.recycle();
        }
    }

    public InstrumentColors stale() {
        return new InstrumentColors(this);
    }
}
