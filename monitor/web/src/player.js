// The controls of a recording: play and pause, how fast, and where. Hidden while a running cell is shown.
import {h, setText, throttled} from './dom.js';
import {clock} from './format.js';

const speeds = [0.1, 0.25, 0.5, 1, 2, 4, 8, 16];
const settled = 700; // [ms] after the last touch the slider follows the recording again

export class Player {
  /** `send(request)` tells the server. */
  constructor(root, send) {
    this.root = root;
    this.send = send;
    this.playing = false;
    this.touched = -Infinity; // [ms]
    this.button = h('button', {type: 'button', click: () => this.toggle()});
    this.place = h('input', {type: 'range', min: 0, step: 0.01, value: 0, 'aria-label': 'place in the recording'});
    this.time = h('span', {class: 'time'});
    this.speed = h('select', {'aria-label': 'speed'}, ...speeds.map((x) => h('option', {value: x, text: `${x} ×`, selected: x === 1})));
    this.error = h('span', {class: 'error', role: 'alert'});
    const seek = throttled(() => this.send({type: 'seek', t: Number(this.place.value)}), 150);
    this.place.addEventListener('input', () => {
      this.touched = performance.now();
      this.tell(Number(this.place.value));
      seek();
    });
    this.speed.addEventListener('change', () => {
      if (this.playing) this.play();
    });
    root.replaceChildren(this.button, this.place, this.time, this.speed, this.error);
  }

  play() {
    this.send({type: 'play', speed: Number(this.speed.value)});
  }

  toggle() {
    if (this.playing) this.send({type: 'pause'});
    else this.play();
  }

  /** Where it is, in words. */
  tell(t) {
    setText(this.time, `${clock(t)} of ${clock(Number(this.place.max))}`);
    this.place.setAttribute('aria-valuetext', this.time.textContent);
  }

  draw({cell, player, t}) {
    this.root.hidden = cell.source !== 'recording';
    if (this.root.hidden) return;
    this.place.max = cell.range[1];
    this.playing = player?.playing ?? false;
    setText(this.button, this.playing ? 'Pause' : 'Play');
    setText(this.error, player?.error ? `cannot be read on: ${player.error}` : '');
    if (performance.now() < this.touched + settled || player?.seeking) return;
    this.place.value = t;
    this.tell(t);
  }
}
