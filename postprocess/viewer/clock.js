// SPDX-License-Identifier: GPL-3.0-or-later

export const RATES = [0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];

/** The time that is shown, and how it goes on. */
export class Clock extends EventTarget {
  constructor(from, to) {
    super();
    this.from = from;
    this.to = to;
    this.time = from;
    this.playing = false;
    const wanted = (to - from) / 10; // the whole run in some ten seconds
    this.rate = RATES.reduce((best, rate) => (Math.abs(Math.log(rate / wanted)) < Math.abs(Math.log(best / wanted)) ? rate : best), 1);
  }

  seek(time) {
    this.time = Math.min(this.to, Math.max(this.from, time));
    this.dispatchEvent(new Event("time"));
  }

  play(on = !this.playing) {
    if (on && this.time >= this.to) this.time = this.from;
    this.playing = on && this.to > this.from;
    this.dispatchEvent(new Event("state"));
  }

  /** Goes on by seconds of the viewer's clock. */
  advance(seconds) {
    if (!this.playing) return;
    const next = this.time + this.rate * Math.min(seconds, 0.25);
    this.seek(next);
    if (next >= this.to) this.play(false);
  }
}
