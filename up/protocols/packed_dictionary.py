"""The dictionary of the first packed frame: a frame as it was in flight.

It is part of the wire: another one needs another word in the hello.
"""

# fmt: off
DICTIONARY = (
    b'{"name":"up.telemetry.update","data":{"vetoes":["arduino: the throttle is not low"],"control'
    b'":{"publisher":null},"system":{"uptime_s":30,"clock_ms":37203711,"providers":["altitude","ba'
    b'ttery","heading","location","navigation","orientation","rx"],"period_ms":100},"counters":{"r'
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
    b'roid":{"connected":true,"competitor":null,"batteryLevel":95.0},"load":{"cpu":12,"ram":4,"pan'
    b'ic":false,"delay_ms":0},"ground":{"role":"pilot","tune_in_flight":true},"uplink":{"grounds":'
    b'1,"mb_per_hour":9.06,"mb":1.52,"mb_in_an_hour":10.6,"budget_mb_per_hour":null,"left_out":0},'
    b'"arduino":{"connected":true,"framing":"checked","switch":"high","receiver_valid":true,"imu_v'
    b'alid":true,"failsafe":false,"bias_stored":false,"reset_cause":"power-on","restored":false,"l'
    b'oop_us":1999,"late_us":3,"frame_errors":0,"flight_battery_v":12.45,"flight_battery_low":null'
    b',"flight_battery_critical":null},"armed":true,"in_flight":true,"flight_mode":"FBW","servo":{'
    b'"ailerons":1500,"elevator":1504,"throttle":1512,"rudder":1496},"navigation":{"latitude":49.9'
    b'99327,"longitude":14.499564,"altitude":372.2,"height":3.2,"speed":13.2,"course":292,"climb":'
    b'-0.3,"airspeed":12.1,"heading":275,"motor_stopped":false,"wind":{"speed":3.5,"from":185},"sd'
    b'":{"position":2.6,"altitude":4.1,"wind":0.6,"airspeed":0.6,"heading":1.5},"target":{"latitud'
    b'e":null,"longitude":null,"altitude":null,"radius":null}},"flight_control":{"mode":null,"sele'
    b'cted":null,"fallback":null,"modes":{"CIRCLE":null,"CRUISE":null,"GLIDE":null,"GUIDED":"no_ta'
    b'rget","LAND":null,"LOITER":null,"RETURN":null,"TAKEOFF":"in_flight","MISSION":"no_mission"},'
    b'"board_modes":["FBW","RATE"]},"mission":{"id":"","count":0,"item":null,"distance":null,"is_f'
    b'inished":true},"fence":{"id":"","count":0,"margin":null},"failsafe":{"active":[],"cause":nul'
    b'l}},"id":null,"beacon":916635419}'
)
