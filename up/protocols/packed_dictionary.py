"""The dictionary of the first packed frame: a frame as it was in flight.

It is part of the wire: another one needs another word in the hello.
"""

# fmt: off
DICTIONARY = (
    b'{"name":"up.telemetry.update","data":{"vetoes":["arduino: the throttle is not low"],"control'
    b'":{"publisher":null},"system":{"uptime_s":30,"clock_ms":37203711,"providers":["altitude","ba'
    b'ttery","heading","location","navigation","orientation","rx"],"period_ms":150},"counters":{"r'
    b'eceiver":{"received":544},"mission_control":{"connects":1,"unsent":1},"serial":{"frames":886'
    b',"opened":1},"telemetry":{"frames":203}},"black_box":{"recording":true,"file":"0001-20260101'
    b'T000000Z-default.mcap","megabytes":1.1,"dropped":0,"problem":null},"altitude":371.6,"altitud'
    b'e_required":null,"age_ms":{"altitude":0,"heading":0,"location":317,"orientation":0,"rx":150,'
    b'"battery":0,"servo":0,"flight":150,"navigation":1000},"source":{"altitude":"android","headin'
    b'g":"android","location":"android","orientation":"arduino","rx":"arduino","battery":"android"'
    b',"servo":"arduino","flight":"arduino","navigation":"android"},"heading":{"actual":270,"requi'
    b'red":null},"location":{"latitude":49.999299,"longitude":14.499699,"altitude":374.0,"satellit'
    b'es":12},"home":{"distance":111,"bearing":13,"latitude":50.000269,"longitude":14.500043,"alti'
    b'tude":369.0,"time_s":8},"orientation":{"yaw":-90.2,"pitch":-0.7,"roll":14.5},"rates":{"yaw":'
    b'12.2,"pitch":4.4,"roll":-0.4},"rx":{"ailerons":1644,"elevator":1488,"throttle":1512,"rudder"'
    b':1500,"aux1":2000,"aux2":2000},"mode":"flight controller","flight_controller":"arduino","and'
    b'roid":{"connected":true,"competitor":null,"batteryLevel":95.0},"load":{"cpu":100,"ram":4,"pa'
    b'nic":true,"delay_ms":150},"ground":{"role":"pilot","tune_in_flight":true},"arduino":{"connec'
    b'ted":true,"framing":"checked","switch":"high","receiver_valid":true,"imu_valid":true,"failsa'
    b'fe":false,"bias_stored":false,"reset_cause":"power-on","restored":false,"loop_us":1999,"late'
    b'_us":3,"frame_errors":0,"flight_battery_v":12.45,"flight_battery_low":null,"flight_battery_c'
    b'ritical":null},"armed":true,"in_flight":true,"flight_mode":"FBW","servo":{"ailerons":1500,"e'
    b'levator":1504,"throttle":1512,"rudder":1496},"navigation":{"latitude":49.999327,"longitude":'
    b'14.499564,"altitude":372.2,"height":3.2,"speed":13.2,"course":292,"climb":-0.3,"airspeed":12'
    b'.1,"heading":275,"motor_stopped":false,"wind":{"speed":3.5,"from":185},"sd":{"position":2.6,'
    b'"altitude":4.1,"wind":0.6,"airspeed":0.6,"heading":1.5},"target":{"latitude":null,"longitude'
    b'":null,"altitude":null,"radius":null}},"flight_control":{"mode":null,"selected":null,"fallba'
    b'ck":null,"modes":{"CIRCLE":null,"CRUISE":null,"GLIDE":null,"GUIDED":"no_target","LAND":null,'
    b'"LOITER":null,"RETURN":null,"TAKEOFF":"in_flight","MISSION":"no_mission"},"board_modes":["FB'
    b'W","RATE"]},"mission":{"id":"","count":0,"item":null,"distance":null,"is_finished":true},"fe'
    b'nce":{"id":"","count":0,"margin":null},"failsafe":{"active":[],"cause":null}},"id":null,"bea'
    b'con":916635419}'
)
