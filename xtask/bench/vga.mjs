// A Raspberry Pi Pico with a VGA monitor: node vga.mjs FIRMWARE FOLDER PICTURES REFRESHES LATE
//
// Runs the firmware until the monitor has shown that many different pictures and refreshes, and leaves in the folder each picture
// (picture-0.ppm and so on) and bench.json: the timing of the signal, and of each row. LATE is the address of the firmware's
// count of late rows; it is read in each vertical blank, for comparison with what was seen to repeat.

import fs from 'node:fs';
import path from 'node:path';
import { loadElf, run } from './mcu.mjs';
import { Monitor } from './monitor.mjs';

/** A pin that is high while a row is shaded, as in the README of the firmware. */
const BUSY = 22;
/** For how many refreshes a picture may stay. */
const PATIENCE = 60;

const [firmware, folder, pictures, refreshes, late] = process.argv.slice(2);
const mcu = loadElf(firmware);
const { chip, core, clock } = mcu;

// rp2040js runs state machines from timers of its own, one instruction after the other, without delays or dividers of their clock.
// Here each takes a step when its clock ticks, and sees a flag one tick after it was raised. All must share a clock.
const pio = chip.pio[0];
let divisor = 0;
let ticking = false;
const tick = clock.createAlarm(() => {
  if (pio.stopped) return;
  const machines = pio.machines.filter((machine) => machine.enabled);
  if (divisor === 0) {
    divisor = machines[0].clockDivInt;
    if (machines.some((machine) => machine.clockDivInt !== divisor || machine.clockDivFrac !== 0)) throw new Error('several clocks');
  }
  const flags = pio.irq;
  let [raised, cleared] = [0, 0];
  ticking = true;
  for (const machine of machines) {
    if (machine.delay > 0) {
      machine.delay--;
      continue;
    }
    pio.irq = flags;
    if (machine.waiting) {
      machine.checkWait();
      if (!machine.waiting) machine.delay = Math.max(0, machine.waitDelay);
    } else {
      const before = machine.cycles;
      machine.step();
      machine.delay = machine.waiting ? 0 : machine.cycles - before - 1;
    }
    raised |= pio.irq & ~flags;
    cleared |= flags & ~pio.irq;
  }
  ticking = false;
  pio.irq = (flags & ~cleared) | raised;
  if (pio.pinValues !== pins) {
    pins = pio.pinValues;
    monitor.change(now(), pins & driven());
  }
  tick.schedule((divisor * 1e9) / chip.clkSys);
});
let pins = -1;
let begin = 0;
pio.run = () => {
  begin = clock.nanos;
  tick.schedule(1e9 / chip.clkSys);
};
pio.irqUpdated = () => pio.checkInterrupts();
for (const machine of pio.machines) {
  const check = machine.checkWait.bind(machine);
  // Nothing but a tick ends a wait; not a FIFO that the processor or the DMA reads or fills.
  Object.assign(machine, { delay: 0, clkDivRestart: () => {}, checkWait: () => ticking && check() });
}

/** Cycles of the processor since the state machines started. */
const now = () => Math.round(((clock.nanos - begin) * chip.clkSys) / 1e9);

/** The pins that are the state machines' to drive. */
const driven = () => {
  const given = chip.gpio.reduce((mask, pin) => (pin.functionSelect === 6 ? mask | (1 << pin.index) : mask), 0);
  return given & pio.pinDirections;
};

// Which row a line shows: the place in memory from which the DMA was told to feed the pixels, and that of the line before it.
let loaded = { place: 0, before: 0, slack: null };
for (const channel of chip.dma.channels) {
  const start = channel.start.bind(channel);
  channel.start = () => {
    start();
    // The request of a FIFO that leads out of a state machine.
    if (channel.treq >= 4) return;
    loaded = { place: channel.readAddr, before: loaded.place, slack: shaded.to === Infinity ? null : now() - shaded.to };
  };
}

// While a row is shaded.
let shaded = { from: 0, to: 0 };
const rows = [];
chip.gpio[BUSY].addListener((level) => {
  if (level === 1) {
    shaded = { from: now(), to: Infinity };
  } else {
    shaded.to = now();
    rows.push(shaded);
  }
});

const read = () => chip.readUint32(Number(late));
const result = { refreshes: [] };
let [before, same, seen] = [null, 0, 0];
let shown = { place: 0, repeats: [], odd: 0, slack: [] };
const monitor = new Monitor({
  // A line of the picture begins.
  line(y) {
    if (y % 2 === 1) {
      shown.odd += loaded.place !== shown.place;
    } else {
      if (loaded.place === shown.place) shown.repeats.push(y / 2);
      shown.place = loaded.place;
      // For how long it had been ready when it was needed; or that it was not.
      shown.slack.push(loaded.slack);
    }
  },
  // A refresh ends: the vertical sync begins.
  refresh({ picture, ...timing }) {
    if (picture) {
      const { repeats, odd, slack } = shown;
      const times = rows.splice(0).map(({ from, to }) => to - from);
      const different = !before?.equals(picture);
      if (different) {
        fs.writeFileSync(path.join(folder, `picture-${seen++}.ppm`), picture);
        same = 0;
      } else if (++same > PATIENCE) {
        throw new Error(`the same picture for ${PATIENCE} refreshes`);
      }
      before = picture;
      result.refreshes.push({ ...timing, picture: seen - 1, repeats, odd, slack, shading: times, late: read() });
    }
    // By now the DMA was told to feed the first line of the next picture: the last one of this picture is the one before it.
    shown = { place: loaded.before, repeats: [], odd: 0, slack: [] };
    if (!picture) [rows.length, result.late] = [0, read()];
  },
});

run(mcu, () => seen > Number(pictures) && result.refreshes.length >= Number(refreshes));
Object.assign(result, { hertz: chip.clkSys, stack: mcu.stack.top - mcu.stack.least });
fs.writeFileSync(path.join(folder, 'bench.json'), JSON.stringify(result));
// Timers of the emulator's own would keep the process alive.
process.exit(0);
