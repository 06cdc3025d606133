// The way to the server: connects, reads frames, and connects again by itself when it is cut off.

const firstPause = 300; // [ms]
const longestPause = 4000; // [ms]

/** Calls `onFrame(frame)` for every frame and `onChange(connected)` when that changes. */
export class Connection {
  constructor(url, {onFrame, onChange}) {
    this.url = url;
    this.onFrame = onFrame;
    this.onChange = onChange;
    this.pause = firstPause;
    this.socket = null;
    this.heard = performance.now(); // of the newest frame [ms]
    this.open();
  }

  open() {
    const socket = new WebSocket(this.url);
    this.socket = socket;
    socket.addEventListener('open', () => this.onChange(true));
    socket.addEventListener('message', (event) => {
      this.pause = firstPause;
      this.heard = performance.now();
      this.onFrame(JSON.parse(event.data));
    });
    socket.addEventListener('close', () => {
      this.onChange(false);
      setTimeout(() => this.open(), this.pause);
      this.pause = Math.min(2 * this.pause, longestPause);
    });
  }

  /** Asks for something; nothing happens while there is no connection. */
  send(request) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(request));
  }

  /** Seconds since anything came. */
  silence() {
    return (performance.now() - this.heard) / 1000;
  }
}
