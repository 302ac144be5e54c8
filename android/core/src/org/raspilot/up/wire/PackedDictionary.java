package org.raspilot.up.wire;

/** The dictionary of the first packed frame, from up/protocols/packed_dictionary.py. */
final class PackedDictionary {
    static final String TEXT =
            // schema begin
            "{\"name\":\"up.telemetry.update\",\"data\":{\"vetoes\":[\"arduino: the th"
            + "rottle is not low\"],\"control\":{\"publisher\":null},\"system\":{\"upti"
            + "me_s\":30,\"clock_ms\":37203711,\"providers\":[\"altitude\",\"battery\",\""
            + "heading\",\"location\",\"navigation\",\"orientation\",\"rx\"],\"period_ms\""
            + ":100},\"counters\":{\"receiver\":{\"received\":544},\"mission_control\":"
            + "{\"connects\":1,\"unsent\":1},\"serial\":{\"frames\":886,\"opened\":1},\"te"
            + "lemetry\":{\"frames\":203}},\"black_box\":{\"recording\":true,\"file\":\"0"
            + "001-20260101T000000Z-default.mcap\",\"megabytes\":1.1,\"dropped\":0,\""
            + "problem\":null},\"altitude\":371.6,\"altitude_required\":null,\"age_ms"
            + "\":{\"altitude\":0,\"heading\":0,\"location\":317,\"orientation\":0,\"rx\":"
            + "150,\"battery\":0,\"servo\":0,\"flight\":150,\"navigation\":1000},\"sourc"
            + "e\":{\"altitude\":\"android\",\"heading\":\"android\",\"location\":\"android"
            + "\",\"orientation\":\"arduino\",\"rx\":\"arduino\",\"battery\":\"android\",\"se"
            + "rvo\":\"arduino\",\"flight\":\"arduino\",\"navigation\":\"android\"},\"headi"
            + "ng\":{\"actual\":270,\"required\":null},\"location\":{\"latitude\":49.999"
            + "299,\"longitude\":14.499699,\"altitude\":374.0,\"satellites\":12},\"hom"
            + "e\":{\"distance\":111,\"bearing\":13,\"latitude\":50.000269,\"longitude\""
            + ":14.500043,\"altitude\":369.0,\"time_s\":8},\"orientation\":{\"yaw\":-90"
            + ".2,\"pitch\":-0.7,\"roll\":14.5},\"rates\":{\"yaw\":12.2,\"pitch\":4.4,\"ro"
            + "ll\":-0.4},\"rx\":{\"ailerons\":1644,\"elevator\":1488,\"throttle\":1512,"
            + "\"rudder\":1500,\"aux1\":2000,\"aux2\":2000},\"mode\":\"flight controller"
            + "\",\"flight_controller\":\"arduino\",\"android\":{\"connected\":true,\"com"
            + "petitor\":null,\"batteryLevel\":95.0},\"load\":{\"cpu\":12,\"ram\":4,\"pan"
            + "ic\":false,\"delay_ms\":0},\"ground\":{\"role\":\"pilot\",\"tune_in_flight"
            + "\":true},\"uplink\":{\"grounds\":1,\"mb_per_hour\":9.06,\"mb\":1.52,\"mb_i"
            + "n_an_hour\":10.6,\"budget_mb_per_hour\":null,\"left_out\":0},\"arduino"
            + "\":{\"connected\":true,\"framing\":\"checked\",\"switch\":\"high\",\"receive"
            + "r_valid\":true,\"imu_valid\":true,\"failsafe\":false,\"bias_stored\":fa"
            + "lse,\"reset_cause\":\"power-on\",\"restored\":false,\"loop_us\":1999,\"la"
            + "te_us\":3,\"frame_errors\":0,\"flight_battery_v\":12.45,\"flight_batte"
            + "ry_low\":null,\"flight_battery_critical\":null},\"armed\":true,\"in_fl"
            + "ight\":true,\"flight_mode\":\"FBW\",\"servo\":{\"ailerons\":1500,\"elevato"
            + "r\":1504,\"throttle\":1512,\"rudder\":1496},\"navigation\":{\"latitude\":"
            + "49.999327,\"longitude\":14.499564,\"altitude\":372.2,\"height\":3.2,\"s"
            + "peed\":13.2,\"course\":292,\"climb\":-0.3,\"airspeed\":12.1,\"heading\":2"
            + "75,\"motor_stopped\":false,\"wind\":{\"speed\":3.5,\"from\":185},\"sd\":{\""
            + "position\":2.6,\"altitude\":4.1,\"wind\":0.6,\"airspeed\":0.6,\"heading\""
            + ":1.5},\"target\":{\"latitude\":null,\"longitude\":null,\"altitude\":null"
            + ",\"radius\":null}},\"flight_control\":{\"mode\":null,\"selected\":null,\""
            + "fallback\":null,\"modes\":{\"CIRCLE\":null,\"CRUISE\":null,\"GLIDE\":null"
            + ",\"GUIDED\":\"no_target\",\"LAND\":null,\"LOITER\":null,\"RETURN\":null,\"T"
            + "AKEOFF\":\"in_flight\",\"MISSION\":\"no_mission\"},\"board_modes\":[\"FBW\""
            + ",\"RATE\"]},\"mission\":{\"id\":\"\",\"count\":0,\"item\":null,\"distance\":nu"
            + "ll,\"is_finished\":true},\"fence\":{\"id\":\"\",\"count\":0,\"margin\":null}"
            + ",\"failsafe\":{\"active\":[],\"cause\":null}},\"id\":null,\"beacon\":91663"
            + "5419}"
            // schema end
            ;

    private PackedDictionary() {
    }
}
