package org.raspilot.up.providers;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.util.Random;
import org.junit.Test;

/** Attitudes by hand, and that any mounting gives the aircraft's attitude and rates. */
public final class MountingTest {
    private static final double EXACT_DEG = 1e-4;
    private static final long SEED = 20261121;

    /** Half a turn about the axis to the top edge: the screen down, the top edge to the north. */
    private static final Rotation SCREEN_DOWN = new Rotation(0, 0, 1, 0, 0);

    @Test
    public void attitudesByHand() {
        // Android: the identity is the screen up and the top edge (y) to the north.
        assertAttitude(0, 0, 0, Mounting.FLAT.attitude(turned(0, 0, 0, 1), 0));
        assertAttitude(0, 0, 90, Mounting.FLAT.attitude(turned(-90, 0, 0, 1), 0));
        assertAttitude(0, 0, 270, Mounting.FLAT.attitude(turned(90, 0, 0, 1), 0));
        // Right-handed about the axis to the right edge: the top edge goes up.
        assertAttitude(0, 30, 0, Mounting.FLAT.attitude(turned(30, 1, 0, 0), 0));
        // About the axis to the top edge: the right edge goes down.
        assertAttitude(40, 0, 0, Mounting.FLAT.attitude(turned(40, 0, 1, 0), 0));
        Mounting onItsSide = Mounting.of(Side.RIGHT, Side.SCREEN);
        assertAttitude(0, 0, 90, onItsSide.attitude(turned(0, 0, 0, 1), 0));
        assertAttitude(0, -20, 90, onItsSide.attitude(turned(20, 0, 1, 0), 0));
        assertAttitude(0, 0, 0, Mounting.of(Side.TOP, Side.BACK).attitude(SCREEN_DOWN, 0));
        assertAttitude(180, 0, 0, Mounting.FLAT.attitude(SCREEN_DOWN, 0));
        // The top edge up, the screen to the south.
        assertAttitude(0, 0, 180,
                Mounting.of(Side.SCREEN, Side.TOP).attitude(turned(90, 1, 0, 0), 0));
    }

    @Test
    public void oneSideCannotBeAheadAndUp() {
        for (Side side : Side.values()) {
            for (Side up : Side.values()) {
                boolean isPossible = side.x() * up.x() + side.y() * up.y() + side.z() * up.z() == 0;
                try {
                    Mounting.of(side, up);
                    assertTrue(side + " ahead, " + up + " up", isPossible);
                } catch (IllegalArgumentException error) {
                    assertTrue(side + " ahead, " + up + " up", !isPossible);
                }
            }
        }
    }

    @Test
    public void attitudesComeBackThroughAnyMounting() {
        Random random = new Random(SEED);
        for (int trial = 0; trial < 40; trial++) {
            Mounting mounting = new Mounting(anyRotation(random));
            for (double roll = -179; roll <= 180; roll += 37) {
                for (double pitch = -89.5; pitch <= 89.6; pitch += 12.7) {
                    for (double yaw = 0; yaw < 360; yaw += 41) {
                        Rotation device = mounting.rotation(new Attitude(roll, pitch, yaw), 0);
                        assertAttitude(roll, pitch, yaw, mounting.attitude(device, 0));
                    }
                }
            }
        }
    }

    @Test
    public void aQuaternionAndItsNegativeAreTheSameAttitude() {
        Quaternion q = Mounting.FLAT.rotation(new Attitude(33, -21, 250), 0).deviceToWorld;
        Rotation negative = new Rotation(-q.w, -q.x, -q.y, -q.z, 0);
        assertAttitude(33, -21, 250, Mounting.FLAT.attitude(negative, 0));
    }

    @Test
    public void theDeclinationTurnsTheYawOnlyAndStaysWithinTheCircle() {
        Rotation rotation = Mounting.FLAT.rotation(new Attitude(10, 20, 358), 0);
        assertAttitude(10, 20, 3, Mounting.FLAT.attitude(rotation, 5));
        assertAttitude(10, 20, 353, Mounting.FLAT.attitude(rotation, -5));
    }

    @Test
    public void ratesAreThoseByWhichTheAttitudeChanges() {
        Random random = new Random(SEED);
        for (int trial = 0; trial < 500; trial++) {
            Mounting mounting = new Mounting(anyRotation(random));
            double roll = 360 * random.nextDouble() - 180;
            double pitch = 140 * random.nextDouble() - 70;
            double yaw = 360 * random.nextDouble();
            double[] changesDegS = new double[3];
            for (int at = 0; at < 3; at++) {
                changesDegS[at] = 200 * random.nextDouble() - 100;
            }
            // The body's rates of these changes of the three angles (kinematics of Euler angles).
            double phi = Math.toRadians(roll);
            double theta = Math.toRadians(pitch);
            double p = changesDegS[0] - changesDegS[2] * Math.sin(theta);
            double q = changesDegS[1] * Math.cos(phi)
                    + changesDegS[2] * Math.cos(theta) * Math.sin(phi);
            double r = -changesDegS[1] * Math.sin(phi)
                    + changesDegS[2] * Math.cos(theta) * Math.cos(phi);
            double halfS = 0.0005;
            Rotation before = mounting.rotation(new Attitude(roll - changesDegS[0] * halfS,
                    pitch - changesDegS[1] * halfS, yaw - changesDegS[2] * halfS), 0);
            Rotation after = mounting.rotation(new Attitude(roll + changesDegS[0] * halfS,
                    pitch + changesDegS[1] * halfS, yaw + changesDegS[2] * halfS), 1);
            double[] rates = mounting.ratesDegS(RotationRate.between(before, after));
            assertEquals("roll rate, trial " + trial, p, rates[0], 0.01);
            assertEquals("pitch rate, trial " + trial, q, rates[1], 0.01);
            assertEquals("yaw rate, trial " + trial, r, rates[2], 0.01);
        }
    }

    @Test
    public void theGyroscopesAxesAreTheAircraftsByTheMounting() {
        RotationRate aboutTop = new RotationRate(0, 1, 0, 0);
        // Flat, the top edge is the nose: the right edge goes down, it rolls to the right.
        assertEquals(57.29578, Mounting.FLAT.ratesDegS(aboutTop)[0], 1e-4);
        // With the right edge ahead the same is the nose going down.
        double[] onItsSide = Mounting.of(Side.RIGHT, Side.SCREEN).ratesDegS(aboutTop);
        assertEquals(0, onItsSide[0], 1e-9);
        assertEquals(-57.29578, onItsSide[1], 1e-4);
        // Turning left, seen from above, is a negative yaw rate.
        assertEquals(-57.29578,
                Mounting.FLAT.ratesDegS(new RotationRate(0, 0, 1, 0))[2], 1e-4);
    }

    @Test
    public void calibrationMakesAnySlopeLevelAndKeepsTheNose() {
        Random random = new Random(SEED);
        int refused = 0;
        for (int trial = 0; trial < 400; trial++) {
            Rotation rotation = new Rotation(anyRotation(random), 0);
            for (Side nose : Side.values()) {
                double[] ahead =
                        rotation.deviceToWorld.turn(nose.x(), nose.y(), nose.z());
                try {
                    Attitude level = Mounting.level(rotation, nose).attitude(rotation, 0);
                    assertEquals(0, level.rollDeg, EXACT_DEG);
                    assertEquals(0, level.pitchDeg, EXACT_DEG);
                    double yaw = Math.toDegrees(Math.atan2(ahead[0], ahead[1]));
                    assertAngle(yaw, level.yawDeg);
                    assertTrue(Math.abs(ahead[2]) <= 0.867);
                } catch (IllegalArgumentException error) {
                    refused++;
                    assertTrue(Math.abs(ahead[2]) >= 0.866);
                    assertTrue(error.getMessage(), error.getMessage().contains(
                            ahead[2] > 0 ? "points up" : "points down"));
                }
            }
        }
        assertTrue(refused > 50);
    }

    @Test
    public void afterCalibrationTheAeroplanesOwnAttitudeIsTold() {
        // In its mount the phone's top edge points 7 degrees up and its right edge 4 degrees down.
        Mounting inMount = new Mounting(Mounting.FLAT.bodyToDevice
                .times(new Attitude(4, 7, 0).bodyToNed().conjugate()));
        Rotation onTheGround = inMount.rotation(new Attitude(0, 0, 200), 0);
        assertAttitude(4, 7, 200, Mounting.FLAT.attitude(onTheGround, 0));
        Mounting found = Mounting.level(onTheGround, Side.TOP);
        Rotation inFlight = inMount.rotation(new Attitude(25, -10, 80), 0);
        assertAttitude(25, -10, 80, found.attitude(inFlight, 0));
    }

    @Test
    public void aMountingIsStoredAsText() {
        Random random = new Random(SEED);
        for (int trial = 0; trial < 100; trial++) {
            Mounting mounting = new Mounting(anyRotation(random));
            Mounting read = Mounting.fromText(" " + mounting.toText() + "\n");
            Rotation rotation = mounting.rotation(new Attitude(12, 34, 56), 0);
            assertAttitude(12, 34, 56, read.attitude(rotation, 0));
        }
    }

    @Test
    public void aTextThatIsNoMountingIsRefusedByASentence() {
        String[] texts = {"", "1 0 0", "1 0 0 0 0", "a b c d", "0 0 0 0", "NaN 0 0 1",
            "Infinity 0 0 0", "1e400 0 0 0"};
        for (String text : texts) {
            IllegalArgumentException error = assertThrows(IllegalArgumentException.class, () ->
                    Mounting.fromText(text));
            assertTrue(error.getMessage(), error.getMessage().startsWith("the mounting "));
        }
    }

    private static Rotation turned(double deg, double x, double y, double z) {
        return new Rotation(Quaternion.about(Math.toRadians(deg), x, y, z), 0);
    }

    private static Quaternion anyRotation(Random random) {
        return new Quaternion(random.nextGaussian(), random.nextGaussian(),
                random.nextGaussian(), random.nextGaussian()).unit();
    }

    private static void assertAttitude(double roll, double pitch, double yaw, Attitude found) {
        String what = "roll " + roll + ", pitch " + pitch + ", yaw " + yaw + " (seed " + SEED + ")";
        assertAngle(what, roll, found.rollDeg);
        assertEquals(what, pitch, found.pitchDeg, EXACT_DEG);
        assertAngle(what, yaw, found.yawDeg);
        assertTrue(what, found.yawDeg >= 0 && found.yawDeg < 360);
    }

    private static void assertAngle(double expectedDeg, double foundDeg) {
        assertAngle("an angle", expectedDeg, foundDeg);
    }

    private static void assertAngle(String what, double expectedDeg, double foundDeg) {
        double apart = Math.IEEEremainder(foundDeg - expectedDeg, 360);
        assertEquals(what + ", found " + foundDeg, 0, apart, EXACT_DEG);
    }
}
