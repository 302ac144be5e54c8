import { randomBytes } from "node:crypto";
import { request } from "node:http";

const TEXT = 1;
const PING = 9;
const PONG = 10;

/** A WebSocket of a program without a browser, as far as the page's connection uses one. */
export class Socket {
  #stream = null;
  #waiting = Buffer.alloc(0);
  readyState = 0;

  constructor(url) {
    const key = randomBytes(16).toString("base64");
    const headers = {
      Connection: "Upgrade",
      Upgrade: "websocket",
      "Sec-WebSocket-Key": key,
      "Sec-WebSocket-Version": "13",
    };
    const asking = request(url.replace(/^ws/, "http"), { headers });
    asking.on("upgrade", (_answer, stream, head) => this.#opened(stream, head));
    asking.on("error", (error) => this.#closed(error.message));
    asking.end();
  }

  send(text) {
    this.#write(TEXT, Buffer.from(text));
  }

  close() {
    this.readyState = 3;
    this.#stream?.destroy();
  }

  #opened(stream, head) {
    this.#stream = stream;
    this.readyState = 1;
    stream.setNoDelay(true);
    stream.on("data", (data) => this.#take(data));
    stream.on("error", () => {});
    stream.on("close", () => this.#closed("closed"));
    this.onopen();
    this.#take(head);
  }

  #closed(reason) {
    this.readyState = 3;
    this.onclose?.({ reason });
  }

  #write(kind, payload) {
    const mask = randomBytes(4);
    const long = payload.length > 125;
    const head = Buffer.from([0x80 | kind, 0x80 | (long ? 126 : payload.length)]);
    const size = Buffer.alloc(long ? 2 : 0);
    if (long) {
      size.writeUInt16BE(payload.length);
    }
    const masked = payload.map((each, place) => each ^ mask[place % 4]);
    this.#stream.write(Buffer.concat([head, size, mask, masked]));
  }

  #take(data) {
    this.#waiting = Buffer.concat([this.#waiting, data]);
    for (let whole = this.#next(); whole !== null; whole = this.#next()) {
      const [kind, payload] = whole;
      if (kind === TEXT) {
        this.onmessage({ data: payload.toString() });
      } else if (kind === PING) {
        this.#write(PONG, payload);
      }
    }
  }

  #next() {
    const waiting = this.#waiting;
    if (waiting.length < 2) {
      return null;
    }
    const short = waiting[1] & 0x7f;
    const start = short === 127 ? 10 : short === 126 ? 4 : 2;
    if (waiting.length < start) {
      return null;
    }
    const size =
      short === 127
        ? Number(waiting.readBigUInt64BE(2))
        : short === 126
          ? waiting.readUInt16BE(2)
          : short;
    if (waiting.length < start + size) {
      return null;
    }
    this.#waiting = waiting.subarray(start + size);
    return [waiting[0] & 0x0f, waiting.subarray(start, start + size)];
  }
}
