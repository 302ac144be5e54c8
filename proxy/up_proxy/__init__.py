"""The ground station proxy: relays between aircraft and ground on a public host."""
