package org.raspilot.up.providers;

/**
 * Altitude by pressure in the International Standard Atmosphere, up to 20 km.
 *
 * <p>Source: ICAO Doc 7488; US Standard Atmosphere, 1976.
 */
public final class StandardAtmosphere {
    /** The pressure at altitude zero, hPa. */
    public static final double SEA_LEVEL_HPA = 1013.25;

    private static final double SEA_LEVEL_K = 288.15;
    private static final double LAPSE_K_M = 0.0065;
    private static final double GAS_J_KG_K = 287.05287;
    private static final double GRAVITY_M_S2 = 9.80665;
    private static final double TROPOPAUSE_M = 11000;
    private static final double TROPOPAUSE_K = SEA_LEVEL_K - LAPSE_K_M * TROPOPAUSE_M;
    private static final double EXPONENT = LAPSE_K_M * GAS_J_KG_K / GRAVITY_M_S2;
    private static final double TROPOPAUSE_SHARE =
            Math.pow(TROPOPAUSE_K / SEA_LEVEL_K, 1 / EXPONENT);
    private static final double ISOTHERMAL_M = GAS_J_KG_K * TROPOPAUSE_K / GRAVITY_M_S2;

    private StandardAtmosphere() {}

    /** Returns metres above the level of the reference pressure; both in hPa, above 0. */
    public static double altitudeM(double pressureHPa, double referenceHPa) {
        double share = pressureHPa / referenceHPa;
        if (share < TROPOPAUSE_SHARE) {
            return TROPOPAUSE_M - ISOTHERMAL_M * Math.log(share / TROPOPAUSE_SHARE);
        }
        return SEA_LEVEL_K / LAPSE_K_M * (1 - Math.pow(share, EXPONENT));
    }
}
