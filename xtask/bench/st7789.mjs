// Panels of 240 x 240 pixels at a 4-wire SPI port: what a controller such as the ST7789 makes of the bytes.

const WIDTH = 240;
const HEIGHT = 240;

// As the panels are sold: their glass shows the complement unless inversion is on, and some want blue first.
export const PANELS = {
  st7789: { rows: 320, blueFirst: false },
  gc9a01: { rows: 240, blueFirst: true },
};

// Bits of MADCTL.
const ROWS_FROM_BOTTOM = 0x80;
const COLUMNS_FROM_RIGHT = 0x40;
const EXCHANGED = 0x20;
const BLUE_FIRST = 0x08;

/** A panel. `onFrame(frame)` is called when the last pixel of its window is there. */
export class Panel {
  constructor(kind, onFrame) {
    Object.assign(this, PANELS[kind]);
    this.onFrame = onFrame;
    this.memory = new Uint16Array(WIDTH * this.rows);
    this.reset();
  }

  reset() {
    Object.assign(this, { asleep: true, on: false, inverted: false, order: 0, bits: 18 });
    Object.assign(this, { left: 0, right: WIDTH - 1, top: 0, bottom: this.rows - 1 });
    Object.assign(this, { command: -1, parameters: [], high: -1, frame: null });
  }

  /** Takes a byte in; `data` is the level of D/C at its last bit, `begin` and `end` are its time on the wire in ns. */
  receive(byte, data, begin, end) {
    if (!data) {
      [this.command, this.parameters, this.high] = [byte, [], -1];
      this.execute();
    } else if (this.command === 0x2c) {
      this.pixel(byte, begin, end);
    } else {
      this.parameters.push(byte);
      this.execute();
    }
  }

  /** Does what the command and the parameters so far ask for. */
  execute() {
    const given = this.parameters;
    const range = given.length === 4 ? [(given[0] << 8) | given[1], (given[2] << 8) | given[3]] : null;
    if (this.command === 0x01) this.reset();
    else if (this.command === 0x10) this.asleep = true;
    else if (this.command === 0x11) this.asleep = false;
    else if (this.command === 0x20) this.inverted = false;
    else if (this.command === 0x21) this.inverted = true;
    else if (this.command === 0x28) this.on = false;
    else if (this.command === 0x29) this.on = true;
    else if (this.command === 0x2a && range) [this.left, this.right] = range;
    else if (this.command === 0x2b && range) [this.top, this.bottom] = range;
    else if (this.command === 0x2c) Object.assign(this, { x: this.left, y: this.top, frame: { rows: [] } });
    else if (this.command === 0x36 && given.length === 1) this.order = given[0];
    else if (this.command === 0x3a && given.length === 1) this.bits = { 3: 12, 5: 16, 6: 18 }[given[0] & 7];
  }

  /** Takes a byte of a pixel in. */
  pixel(byte, begin, end) {
    if (this.bits !== 16) throw new Error(`pixels of ${this.bits} bits`);
    if (this.high < 0) {
      this.high = byte;
      if (this.x === this.left) this.frame?.rows.push({ begin });
      return;
    }
    let [column, row] = this.order & EXCHANGED ? [this.y, this.x] : [this.x, this.y];
    if (this.order & COLUMNS_FROM_RIGHT) column = WIDTH - 1 - column;
    if (this.order & ROWS_FROM_BOTTOM) row = this.rows - 1 - row;
    if (column >= 0 && column < WIDTH && row >= 0 && row < this.rows) {
      this.memory[row * WIDTH + column] = (this.high << 8) | byte;
    }
    this.high = -1;
    if (++this.x <= this.right) return;
    this.x = this.left;
    const { frame } = this;
    if (frame) frame.rows.at(-1).end = end;
    if (++this.y <= this.bottom) return;
    // Without a new command the next pixel goes to the first place again; it belongs to no frame.
    [this.y, this.frame] = [this.top, null];
    if (frame) this.onFrame(frame);
  }

  /** What is seen: a PPM file. */
  picture() {
    const pixels = Buffer.alloc(3 * WIDTH * HEIGHT);
    for (let at = 0; at < WIDTH * HEIGHT && this.on && !this.asleep; at++) {
      const bits = this.inverted ? this.memory[at] : ~this.memory[at];
      const color = [((bits >> 11) & 31) / 31, ((bits >> 5) & 63) / 63, (bits & 31) / 31];
      if (!!(this.order & BLUE_FIRST) !== this.blueFirst) color.reverse();
      pixels.set(color.map((channel) => Math.round(channel * 255)), 3 * at);
    }
    return Buffer.concat([Buffer.from(`P6 ${WIDTH} ${HEIGHT} 255\n`), pixels]);
  }
}
