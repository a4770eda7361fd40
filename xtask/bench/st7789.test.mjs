// What a panel makes of bytes: node --test

import assert from 'node:assert/strict';
import test from 'node:test';
import { Panel } from './st7789.mjs';

/** A panel that is on, with pixels of 16 bits; `setup` are more commands, each with its parameters. */
function panel(kind, setup, onFrame = () => {}) {
  const panel = new Panel(kind, onFrame);
  for (const [command, ...parameters] of [[0x11], [0x29], [0x3a, 0x55], ...setup]) {
    panel.receive(command, false, 0, 0);
    parameters.forEach((byte) => panel.receive(byte, true, 0, 0));
  }
  return panel;
}

const send = (panel, bytes) => bytes.forEach((byte, at) => panel.receive(byte, true, 10 * at, 10 * at + 10));
/** A pixel of what is seen. */
const seen = (panel, x, y) => [...panel.picture().subarray(-3 * 240 * 240).subarray(3 * (240 * y + x)).subarray(0, 3)];
/** The window of columns 2 to 3 and rows 5 to 6, and pixels into it. */
const WINDOW = [[0x2a, 0, 2, 0, 3], [0x2b, 0, 5, 0, 6], [0x2c]];
const [RED, GREEN, BLUE, WHITE] = [[0xf8, 0x00], [0x07, 0xe0], [0x00, 0x1f], [0xff, 0xff]];

test('pixels fill the window row by row, and a frame tells when its rows came', () => {
  const frames = [];
  const st7789 = panel('st7789', [[0x21], ...WINDOW], (frame) => frames.push(frame));
  send(st7789, [...RED, ...GREEN, ...BLUE, ...WHITE]);
  assert.deepEqual([seen(st7789, 2, 5), seen(st7789, 3, 5)], [[255, 0, 0], [0, 255, 0]]);
  assert.deepEqual([seen(st7789, 2, 6), seen(st7789, 3, 6)], [[0, 0, 255], [255, 255, 255]]);
  assert.deepEqual(frames, [{ rows: [{ begin: 0, end: 40 }, { begin: 40, end: 80 }] }]);
  // More pixels without a command start over, but are no frame.
  send(st7789, [...GREEN, ...GREEN, ...GREEN, ...GREEN]);
  assert.deepEqual(seen(st7789, 2, 5), [0, 255, 0]);
  assert.equal(frames.length, 1);
});

test('without inversion the glass shows the complement, and what is off or asleep shows nothing', () => {
  const st7789 = panel('st7789', WINDOW);
  send(st7789, RED);
  assert.deepEqual(seen(st7789, 2, 5), [0, 255, 255]);
  st7789.receive(0x28, false, 0, 0);
  assert.deepEqual(seen(st7789, 2, 5), [0, 0, 0]);
});

test('the round panel wants blue first', () => {
  const [plain, exchanged] = [[], [[0x36, 0x08]]].map((order) => panel('gc9a01', [[0x21], ...order, ...WINDOW]));
  [plain, exchanged].forEach((gc9a01) => send(gc9a01, RED));
  assert.deepEqual([seen(plain, 2, 5), seen(exchanged, 2, 5)], [[0, 0, 255], [255, 0, 0]]);
});

test('the order of rows and columns is what MADCTL says', () => {
  const corner = { 0x40: [237, 5], 0x80: [2, 234], 0x20: [5, 2] };
  for (const [order, [x, y]] of Object.entries(corner)) {
    const gc9a01 = panel('gc9a01', [[0x21], [0x36, Number(order) | 0x08], ...WINDOW]);
    send(gc9a01, GREEN);
    assert.deepEqual(seen(gc9a01, x, y), [0, 255, 0], `order ${order}`);
  }
});

test('pixels of another size are refused', () => {
  assert.throws(() => send(panel('st7789', [[0x3a, 0x66], ...WINDOW]), RED), /18 bits/);
});
