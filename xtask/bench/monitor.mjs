// A VGA monitor for 640 x 480 at 60 Hz: what it makes of the levels on its wires.

/** The wires, by bits: colours of 5 bits each, and sync, which is low when it is on. */
const RED = 0;
const GREEN = 6;
const BLUE = 11;
const HSYNC = 1 << 16;
const VSYNC = 1 << 17;
const COLORS = 0xffff;

/** Lines and pixels from the beginning of the sync to the picture: sync and back porch. */
const TOP = 2 + 33;
const LEFT = 96 + 48;
/** The picture, of which each pixel is doubled on the way here, and the pixels of a line. */
const WIDTH = 320;
const HEIGHT = 240;
const TOTAL = 800;

export class Monitor {
  /** `line(y)` is called when line y of 480 begins with its sync, `refresh({..})` when the vertical sync begins. */
  constructor({ line, refresh }) {
    Object.assign(this, { onLine: line, onRefresh: refresh });
    Object.assign(this, { pins: HSYNC | VSYNC, changes: [], begin: -1, period: 0, number: -1 });
    this.start(-1);
  }

  start(begin) {
    this.frame = { begin, lines: 0, periods: new Set(), hsyncs: new Set(), vsync: 0, phases: new Set(), blank: true, doubled: true };
    this.pixels = Buffer.alloc(3 * WIDTH * HEIGHT);
  }

  /** The levels change at a cycle. */
  change(cycle, pins) {
    const [fallen, risen] = [this.pins & ~pins, ~this.pins & pins];
    this.changes.push([cycle, this.pins]);
    this.pins = pins;
    if (fallen & HSYNC) this.sync(cycle);
    if (risen & HSYNC && this.begin >= 0) this.frame.hsyncs.add(cycle - this.begin);
    if (fallen & VSYNC) this.end(cycle);
    if (risen & VSYNC && this.frame.begin >= 0) this.frame.vsync = cycle - this.frame.begin;
    if ((fallen | risen) & COLORS && this.period > 0) {
      this.frame.phases.add(((cycle - this.begin) * TOTAL) / this.period % 2);
    }
  }

  /** A line begins, and the one before it is complete. */
  sync(cycle) {
    if (this.begin >= 0) {
      this.period = cycle - this.begin;
      this.frame.periods.add(this.period);
      this.draw(this.number - TOP);
    }
    this.frame.lines++;
    [this.begin, this.changes] = [cycle, this.changes.slice(-1)];
    this.number++;
    const y = this.number - TOP;
    if (this.frame.begin >= 0 && y >= 0 && y < 2 * HEIGHT) this.onLine(y);
  }

  /** The vertical sync begins. */
  end(cycle) {
    const { frame, pixels } = this;
    const header = Buffer.from(`P6 ${WIDTH} ${HEIGHT} 255\n`);
    // The line that begins with it is the next frame's.
    const lists = Object.fromEntries(['periods', 'hsyncs', 'phases'].map((name) => [name, [...frame[name]]]));
    const whole = frame.begin >= 0;
    this.onRefresh({
      ...frame,
      ...lists,
      lines: frame.lines - 1,
      period: cycle - frame.begin,
      offset: cycle - this.begin,
      picture: whole ? Buffer.concat([header, pixels]) : null,
    });
    this.start(cycle);
    [this.frame.lines, this.number] = [1, 0];
  }

  /** Looks at a line in the middle of each of its pixels. */
  draw(y) {
    const { changes, begin, period, frame, pixels } = this;
    const inside = y >= 0 && y < 2 * HEIGHT;
    let at = 0;
    for (let x = 0; x < TOTAL; x++) {
      const cycle = begin + ((x + 0.5) * period) / TOTAL;
      while (at < changes.length && changes[at][0] <= cycle) at++;
      const levels = at < changes.length ? changes[at][1] : this.pins;
      const column = x - LEFT;
      if (!inside || column < 0 || column >= 2 * WIDTH) {
        if (levels & COLORS) frame.blank = false;
        continue;
      }
      const place = 3 * ((y >> 1) * WIDTH + (column >> 1));
      const color = [RED, GREEN, BLUE].map((low) => Math.round((((levels >> low) & 31) * 255) / 31));
      const first = column % 2 === 0 && y % 2 === 0;
      if (first) pixels.set(color, place);
      else if (color.some((level, channel) => pixels[place + channel] !== level)) frame.doubled = false;
    }
  }
}
