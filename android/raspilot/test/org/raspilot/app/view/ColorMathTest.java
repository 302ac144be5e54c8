package org.raspilot.app.view;

import static org.junit.Assert.assertEquals;

import org.junit.Test;

public final class ColorMathTest {
    @Test
    public void aGreyHasNoColourAndKeepsItsAlpha() {
        int grey = ColorMath.grey(0x80ff4010);
        assertEquals(0x80, grey >>> 24);
        assertEquals(grey & 0xff, grey >> 8 & 0xff);
        assertEquals(grey & 0xff, grey >> 16 & 0xff);
        assertEquals(0xffffffff, ColorMath.grey(0xffffffff));
        assertEquals(0xff000000, ColorMath.grey(0xff000000));
    }

    @Test
    public void betweenTwoColoursLiesTheirMean() {
        assertEquals(0xff808080, ColorMath.between(0xff000000, 0xffffffff, 0.502f));
        assertEquals(0xff102030, ColorMath.between(0xff102030, 0xffffffff, 0));
        assertEquals(0xffffffff, ColorMath.between(0xff102030, 0xffffffff, 1));
    }
}
