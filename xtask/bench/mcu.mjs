// The microcontroller: an RP2040 that runs firmware as it is, instruction by instruction.
//
// What differs from a chip: one core, no boot ROM, no wait states of the flash; pushes of the link register and pops of
// the program counter take a cycle less. Other cycles are those of the Cortex-M0+.

import fs from 'node:fs';
import { RP2040 } from 'rp2040js';

const FLASH = 0x10000000;
const RAM = 0x20000000;
const PERIPHERALS = 0x40000000;
/** Behind the second-stage boot loader, which the emulator does not need: the flash is readable from the start. */
const VECTORS = FLASH + 0x100;

/**
 * Loads firmware, and stands at its first instruction.
 *
 * `chip` is rp2040js's RP2040, with `core` and `clock`; `stack.least` is the least stack pointer seen so far.
 */
export function loadElf(path) {
  const chip = new RP2040();
  const silent = () => {};
  const tell = (from, message) => console.error(`${from}: ${message}`);
  chip.logger = { debug: silent, info: silent, warn: tell, error: tell };

  const file = fs.readFileSync(path);
  const [headers, size, count] = [file.readUInt32LE(28), file.readUInt16LE(42), file.readUInt16LE(44)];
  for (let number = 0; number < count; number++) {
    const header = file.subarray(headers + number * size);
    const [type, offset, , address, length] = [0, 4, 8, 12, 16].map((at) => header.readUInt32LE(at));
    const bytes = file.subarray(offset, offset + length);
    // Loadable segments, where they lie in flash; what begins in RAM is copied there by the firmware.
    if (type === 1 && address >= FLASH && address < RAM) chip.flash.set(bytes, address - FLASH);
    else if (type === 1 && length > 0) chip.sram.set(bytes, address - RAM);
  }

  const { core, clock } = chip;
  core.VTOR = VECTORS;
  core.SP = chip.readUint32(VECTORS);
  core.PC = chip.readUint32(VECTORS + 4) & ~1;
  return { chip, core, clock, stack: { top: core.SP >>> 0, least: core.SP >>> 0 } };
}

/** Runs until `until()` is true. `each(cycles)`, where it is given, is called after each instruction. */
export function run(mcu, until, each = () => {}) {
  const { chip, core, clock, stack } = mcu;
  while (!until()) {
    if (core.waiting) {
      // Asleep: on to the next event.
      clock.tick(clock.nanosToNextAlarm || 1e9 / chip.clkSys);
      continue;
    }
    const before = core.cycles;
    core.executeInstruction();
    const cycles = core.cycles - before;
    clock.tick((cycles * 1e9) / chip.clkSys);
    stack.least = Math.min(stack.least, core.SP >>> 0);
    if (core.PC < FLASH || core.PC >= PERIPHERALS) throw new Error(`the firmware went to address ${core.PC.toString(16)}`);
    each(cycles);
  }
}
