// What the search needs in a page without an origin: one read from a disk, or one in the sandbox of
// the ground station. There a browser starts no worker and has no storage.
(() => {
  // In the frame that stands for the worker: messages pass through a port.
  if (location.href === "about:srcdoc") {
    addEventListener("message", (event) => {
      event.stopImmediatePropagation();
      const [port] = event.ports;
      port.onmessage = ({ data }) => dispatchEvent(new MessageEvent("message", { data }));
      window.postMessage = (message) => port.postMessage(message);
    }, { once: true });
    // The worker looks for its own files there.
    window.parent = {};
    return;
  }
  if (window.origin !== "null" && location.protocol !== "file:") {
    return;
  }
  const here = document.currentScript.src;

  window.Worker = class extends EventTarget {
    #port;

    constructor(url) {
      super();
      const { port1, port2 } = new MessageChannel();
      this.#port = port1;
      port1.onmessage = ({ data }) => this.dispatchEvent(new MessageEvent("message", { data }));
      const frame = document.createElement("iframe");
      frame.hidden = true;
      frame.srcdoc = `<script src="${here}"></script><script src="${url}"></script>`;
      frame.addEventListener("load", () => frame.contentWindow.postMessage(null, "*", [port2]));
      document.documentElement.append(frame);
    }

    postMessage(message) {
      this.#port.postMessage(message);
    }
  };

  // The window's name keeps what the reader chose, until the window is closed.
  const kept = () => {
    try {
      return Object(JSON.parse(window.name));
    } catch {
      return {};
    }
  };
  const storage = {
    getItem: (key) => kept()[key] ?? null,
    setItem: (key, value) => (window.name = JSON.stringify({ ...kept(), [key]: value })),
  };
  for (const name of ["localStorage", "sessionStorage"]) {
    try {
      window[name].getItem("");
    } catch {
      Object.defineProperty(window, name, { value: storage });
    }
  }
})();
