import { html } from "../dom.js";
import { Pace, PlainRow, Row } from "../readout.js";
import { ageText, numberText } from "../state/format.js";
import { number, text } from "../state/validate.js";

/** Every stretch of the way from the aircraft to this page. */
export function mount(element, store, connection) {
  const list = html("dl", { class: "rows" });
  element.append(list);
  const plain = {
    age: new PlainRow(list, "Newest frame", "link.age"),
    ages: new PlainRow(list, "Ages", "link.ages"),
    rate: new PlainRow(list, "Rate", "link.rate"),
    lost: new PlainRow(list, "Lost, dropped", "link.lost"),
    page: new PlainRow(list, "This page", "link.page"),
    proxy: new PlainRow(list, "Proxy", "link.proxy"),
    security: new PlainRow(list, "Link to the proxy", "link.tls"),
    keys: new PlainRow(list, "Commands, telemetry", "link.security"),
    latency: new PlainRow(list, "Proxy's round trip", "link.latency"),
    aircraft: new PlainRow(list, "Aircraft", "link.aircraft"),
    data: new PlainRow(list, "Aircraft's data", "link.data"),
  };
  const rows = [
    new Row(list, "Board's serial link", "arduino.connected", "flag", joined, warnIfGone),
    new Row(list, "Phone on board", "android.connected", "flag", joined, warnIfGone),
  ];
  const pace = new Pace();
  let ageShown = null;
  return {
    update() {
      const link = store.status?.link ?? {};
      const isOld = !connection.isOpen;
      const isDoubtful = isOld || isReportOutdated(link, store);
      if (pace.isTime(store.now_s)) {
        const age_s = store.age_s(null);
        ageShown = age_s === null ? null : ageText(age_s);
      }
      plain.age.show(ageShown, store.isSilent ? "warning" : "");
      plain.ages.show(agesText(store), "", isOld || store.isSilent);
      showPage(plain.page, connection);
      showProxy(plain.proxy, link, isDoubtful);
      plain.security.show(securityText(link), "", isDoubtful);
      const isRefused = link.security === "none";
      plain.keys.show(text(link.security_text), isRefused ? "warning" : "", isOld || store.isSilent);
      showNumber(plain.latency, link.round_trip_ms, (ms) => `${numberText(ms)} ms`, isDoubtful);
      showNumber(plain.rate, link.rate_hz, (hz) => `${numberText(hz, 1)} frames/s`, isOld);
      const dropped = number(link.dropped);
      showNumber(plain.lost, link.lost, (lost) => `${lost}, ${numberText(dropped)}`, isOld);
      const isOnline = typeof link.aircraft_online === "boolean" ? link.aircraft_online : null;
      const online = isOnline === null ? null : isOnline ? "at the proxy" : "not at the proxy";
      plain.aircraft.show(online, isOnline === false ? "warning" : "", isDoubtful);
      plain.aircraft.setState(isOnline === false ? "offline" : "online");
      plain.data.show(dataText(store), "", isOld || store.isSilent);
      for (const row of rows) {
        row.update(store);
      }
    },
  };
}

/** A proxy that hangs still counts as connected at the server: its reports are outdated. */
function isReportOutdated(link, store) {
  return store.isSilent && link.state === "connected" && link.aircraft_online !== false;
}

function agesText(store) {
  if (store.frames === 0 || store.replay !== null) {
    return null;
  }
  return store.number("system.clock_ms") === null
    ? "without the delay to the proxy: the aircraft reports no clock"
    : "by the aircraft's clock";
}

/** As `9.0 of 11.0 MB/h, 3.2 MB since start, in an hour 12.2 MB`. */
function dataText(store) {
  const [rate, limit, total, soon] = ["mb_per_hour", "budget_mb_per_hour", "mb", "mb_in_an_hour"].map(
    (name) => store.number(`uplink.${name}`),
  );
  if (!total) {
    return null;
  }
  const budget = limit === null ? "" : ` of ${numberText(limit, 1)}`;
  return `${numberText(rate, 1)}${budget} MB/h, ${numberText(total, 1)} MB since start, in an hour ${numberText(soon, 1)} MB`;
}

function joined(isThere) {
  return isThere ? "connected" : "absent";
}

function warnIfGone(isThere) {
  return isThere ? "" : "warning";
}

function showPage(row, connection) {
  const trip_s = connection.roundTrip_s;
  if (!connection.isOpen) {
    row.show(connection.isFull ? "the ground server is full" : "no ground server", "alarm");
  } else {
    row.show(trip_s === null ? "connected" : `connected, ${numberText(trip_s * 1000)} ms`);
  }
}

function showProxy(row, link, isOld) {
  const state = text(link.state);
  const reason = text(link.reason) ?? "";
  const words = state === null ? null : reason === "" ? state : `${state}: ${reason}`;
  row.show(words, state === "connected" ? "" : "warning", isOld);
  row.setState(state ?? "");
}

/** Whether the link between the ground server and the proxy is protected, and the proxy's name. */
function securityText(link) {
  if (link.state !== "connected") {
    return null;
  }
  const peer = text(link.tls_peer);
  return peer === null ? "plain" : `TLS, ${peer}`;
}

function showNumber(row, found, format, isOld) {
  const value = number(found);
  row.show(value === null ? null : format(value), "", isOld);
}
