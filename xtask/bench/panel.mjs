// A Raspberry Pi Pico with a panel at SPI0: node panel.mjs FIRMWARE PANEL FOLDER FRAMES ADDRESS
//
// Runs the firmware until it has sent that many frames, and leaves in the folder a picture of the panel after each
// (frame-0.ppm and so on) and bench.json: when each row was on the wire, and how many cycles each line took from the
// function at ADDRESS to its return. A frame counts once that function has been called.

import fs from 'node:fs';
import path from 'node:path';
import { loadElf, run } from './mcu.mjs';
import { Panel } from './st7789.mjs';

/** How the panel is wired, as in the README of the firmware: GPIO numbers. */
const PINS = { cs: 17, dc: 20, reset: 21 };
/** For how long a frame may keep us waiting: simulated ns. */
const PATIENCE = 2e9;

const [firmware, kind, folder, frames, address] = process.argv.slice(2);
const mcu = loadElf(firmware);
const { chip, core, clock } = mcu;

/** Time for which the port has been sending, in ns. */
let busy = 0;
const result = { frames: [] };
let deadline = PATIENCE;
const panel = new Panel(kind, (frame) => {
  // What the panel is cleared with is no frame.
  if (lines.length === 0) return;
  fs.writeFileSync(path.join(folder, `frame-${result.frames.length}.ppm`), panel.picture());
  result.frames.push({ ...frame, end: frame.rows.at(-1).end, busy });
  deadline = clock.nanos + PATIENCE;
});

// The port takes a word at a time; its clock says how long that is on the wire.
const spi = chip.spi[0];
const level = (pin) => chip.gpio[pin].value === 1;
let word = null;
const sent = clock.createAlarm(() => {
  const { value, bits, begin } = word;
  const [time, half] = [clock.nanos - begin, (begin + clock.nanos) / 2];
  busy += time;
  // The panel looks at D/C and CS while bits come in, so they must not change before the last one.
  if (!level(PINS.cs)) {
    if (bits === 16) panel.receive(value >> 8, level(PINS.dc), begin, half);
    panel.receive(value & 0xff, level(PINS.dc), bits === 16 ? half : begin, clock.nanos);
  }
  spi.completeTransmit(0);
});
spi.onTransmit = (value) => {
  if (spi.dataBits % 8 !== 0) throw new Error(`words of ${spi.dataBits} bits`);
  word = { value, bits: spi.dataBits, begin: clock.nanos };
  sent.schedule((spi.dataBits * 1e9) / spi.clockFrequency);
};
chip.gpio[PINS.reset].addListener(() => level(PINS.reset) || panel.reset());

// Calls of the function that shades a line: from its first instruction to the one after its call.
const entry = Number(address);
const lines = [];
let back = -1;
const watch = () => {
  if (core.PC === entry) {
    lines.push({ begin: clock.nanos, cycles: -core.cycles });
    back = core.LR & ~1;
  } else if (core.PC === back) {
    const line = lines.at(-1);
    [line.end, line.cycles, back] = [clock.nanos, line.cycles + core.cycles, -1];
  }
};

run(mcu, () => result.frames.length >= Number(frames) || clock.nanos > deadline, watch);
if (result.frames.length < Number(frames)) throw new Error(`after ${result.frames.length} frames nothing more came`);
Object.assign(result, { lines, systemHertz: chip.clkSys, spiHertz: spi.clockFrequency, stack: mcu.stack.top - mcu.stack.least });
fs.writeFileSync(path.join(folder, 'bench.json'), JSON.stringify(result));
// Timers of the emulator's own would keep the process alive.
process.exit(0);
