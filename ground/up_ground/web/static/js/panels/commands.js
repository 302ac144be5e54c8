import { setText } from "../readout.js";
import { Arming } from "./arming.js";
import { Asker } from "./asker.js";
import { element } from "./element.js";
import { FlightModes } from "./flight_modes.js";
import { Wishes } from "./wishes.js";

/** The requests to the aircraft, and the outcome of the last one. */
export function mount(place, store, connection) {
  const asker = new Asker(store, connection);
  const last = element("p", { id: "last-answer", role: "status", "data-look": "plain" });
  const why = element("p.why", { id: "commands-why" });
  const parts = [new FlightModes(store, asker), new Arming(store, asker), new Wishes(store, asker)];
  place.append(why, last, ...parts.map((part) => part.element));
  return {
    update() {
      place.hidden = connection.welcome?.is_replay === true;
      // The action with the most conditions has the fullest reason: a missing role shows here too.
      const words = asker.objection("up.flight_mode.set") || asker.objection("up.arm");
      setText(why, words);
      why.hidden = words === "";
      parts.forEach((part) => part.update());
    },
  };
}
