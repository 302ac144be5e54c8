/** The far end of a page's sockets: records the page's messages, sends what a test defines. */
export class FakeServer {
  sockets = [];

  makeSocket = (url) => {
    const socket = new FakeSocket(url);
    this.sockets.push(socket);
    return socket;
  };

  /** @returns {FakeSocket} the newest */
  get socket() {
    return this.sockets.at(-1);
  }

  /** Let the newest socket open, and welcome its page. */
  welcome(fields = {}) {
    this.socket.open();
    this.socket.say({
      type: "welcome",
      page: 1,
      token: "t-1",
      aircraft: ["one", "two"],
      ...fields,
    });
  }
}

class FakeSocket {
  readyState = 0;
  sent = [];
  isClosed = false;

  constructor(url) {
    this.url = url;
  }

  open() {
    this.readyState = 1;
    this.onopen();
  }

  send(text) {
    this.sent.push(JSON.parse(text));
  }

  close() {
    this.isClosed = true;
    this.readyState = 3;
  }

  say(message) {
    this.onmessage({ data: typeof message === "string" ? message : JSON.stringify(message) });
  }

  fail(reason = "", code = 1006) {
    this.readyState = 3;
    this.onclose({ reason, code });
  }

  /** @returns {object[]} what the page sent of a type */
  of(type) {
    return this.sent.filter((each) => each.type === type);
  }
}
