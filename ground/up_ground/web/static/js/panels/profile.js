import { html } from "../dom.js";
import { CommandSender } from "./command_sender.js";
import { capital } from "../state/format.js";

const OUTPUTS = [
  ["ailerons", "Ailerons", "left elevon"],
  ["elevator", "Elevator", "right elevon"],
  ["throttle", "Throttle", ""],
  ["rudder", "Rudder", ""],
];
const MIXES = {
  none: "none: one servo output for each surface",
  elevon: "elevon: ailerons and elevator are mixed on two surfaces",
  "V-tail": "V-tail: elevator and rudder are mixed on two surfaces",
};

/** The profile `arduino.profile.values` (docs/protocols.md 5) as text; missing values have no row. */
export function profileParts(profile) {
  const isElevon = profile.mix === "elevon";
  return [
    { title: "Airframe", rows: airframeRows(profile) },
    {
      title: "Servo outputs",
      rows: OUTPUTS.map(([key, name, mixed]) => [
        isElevon && mixed ? `${name} (${mixed})` : name,
        servoWords(profile[key]),
      ]),
    },
    {
      title: "Mode switch",
      rows: ["low", "middle", "high"].map((each) => [capital(each), textOf(profile.switch?.[each])]),
    },
    { title: "Limits in FBW", rows: limitRows(profile.fly_by_wire) },
    { title: "Receiver lost", rows: lostRows(profile.receiver_lost) },
  ]
    .map(({ title, rows }) => ({ title, rows: rows.filter(([, words]) => words !== "") }))
    .filter(({ rows }) => rows.length > 0);
}

function airframeRows(profile) {
  const motor = { true: "yes: it needs arming", false: "no: a glider, nothing to arm" };
  return [
    ["Mix", wordOf(MIXES, profile.mix) || textOf(profile.mix)],
    ["Motor", wordOf(motor, profile.motor)],
    ["Throttle rises", slewText(profile.throttle_slew_percent_s)],
  ];
}

function slewText(percent_s) {
  if (!Number.isFinite(percent_s)) {
    return "";
  }
  return percent_s > 0 ? `by at most ${percent_s} %/s` : "without a limit";
}

function servoWords(servo) {
  if (servo === null || typeof servo !== "object") {
    return "";
  }
  const words = [];
  if (typeof servo.reversed === "boolean") {
    words.push(servo.reversed ? "reversed" : "normal");
  }
  if (Number.isFinite(servo.trim_us)) {
    words.push(servo.trim_us === 0 ? "no trim" : `trim ${signed(servo.trim_us)} us`);
  }
  if (Number.isFinite(servo.lowest_us) && Number.isFinite(servo.highest_us)) {
    words.push(`${servo.lowest_us} to ${servo.highest_us} us`);
  }
  return words.join(", ");
}

function limitRows(limits) {
  return [
    ["Bank", degrees(limits?.roll_deg)],
    ["Pitch up", degrees(limits?.pitch_up_deg)],
    ["Pitch down", degrees(limits?.pitch_down_deg)],
  ];
}

function lostRows(lost) {
  const surfaces = ["ailerons", "elevator", "rudder"]
    .filter((each) => Number.isFinite(lost?.[`${each}_us`]))
    .map((each) => `${each} ${lost[`${each}_us`]}`)
    .join(", ");
  const motor = { true: "may use the motor", false: "glides" };
  return [
    ["Throttle then", microseconds(lost?.throttle_us)],
    ["Known by a throttle below", microseconds(lost?.below_us)],
    ["Pitch of the circle", degrees(lost?.glide_pitch_deg, true)],
    ["Bank of the circle", sideways(lost?.circle_bank_deg)],
    ["Surfaces without IMU", surfaces ? `${surfaces} us` : ""],
    ["Raspberry Pi then", wordOf({ true: "may fly", false: "may not fly" }, lost?.pi_may_fly)],
    ["Returning home", wordOf(motor, lost?.return_with_motor)],
  ];
}

function sideways(value) {
  if (!Number.isFinite(value)) {
    return "";
  }
  return `${Math.abs(value)}°${value > 0 ? " to the right" : value < 0 ? " to the left" : ""}`;
}

function degrees(value, hasSign = false) {
  return Number.isFinite(value) ? `${hasSign ? signed(value) : value}°` : "";
}

function microseconds(value) {
  return Number.isFinite(value) ? `${value} us` : "";
}

function signed(value) {
  return value > 0 ? `+${value}` : String(value).replace("-", "−");
}

function wordOf(words, value) {
  return Object.hasOwn(words, String(value)) ? words[String(value)] : "";
}

function textOf(value) {
  return typeof value === "string" ? value : "";
}

const REQUEST = "arduino.profile.request";

/** The airframe as the Arduino holds it, to read. */
export function mount(place, store, connection) {
  const sender = new CommandSender(store, connection);
  const note = html("p.note", { role: "status" });
  const ask = html("button", {
    type: "button",
    id: "profile-ask",
    text: "Ask the aircraft",
    on: { click: () => sender.send(REQUEST, {}, { note }) },
  });
  const how = html("p.quiet", {
    text: "airframe.yml on the aircraft sets it; from here it can only be read.",
  });
  const parts = html("div.profile", { id: "profile" });
  place.append(how, html("div.row", {}, ask), note, parts);
  let shown = null;

  function show(profile) {
    shown = profile;
    parts.replaceChildren();
    for (const { title, rows } of profile === null ? [] : profileParts(profile)) {
      const list = html("dl");
      for (const [name, words] of rows) {
        list.append(html("dt", { text: name }), html("dd", { text: words }));
      }
      parts.append(html("h3", { text: title }), list);
    }
  }

  return {
    update() {
      ask.hidden = store.replay !== null;
      ask.disabled = sender.disabledReason(REQUEST) !== null;
      if (store.profile !== shown) {
        show(store.profile);
      }
    },
  };
}
