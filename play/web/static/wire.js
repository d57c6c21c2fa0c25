"use strict";
// The binary messages: samples of the hand to the room, frames of the table from it.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const HEAD = 5;
  const SAMPLE = 12;
  const FRAME = 24;
  const KIND = 1;

  play.MOST_SAMPLES = 200; // in one message

  // samples: [[time on the page's clock in ms, height in m], ...]
  play.packSamples = function (first, samples) {
    const view = new DataView(new ArrayBuffer(HEAD + SAMPLE * samples.length));
    view.setUint8(0, KIND);
    view.setUint32(1, first, true);
    samples.forEach(([time, height], i) => {
      view.setFloat64(HEAD + SAMPLE * i, time, true);
      view.setFloat32(HEAD + SAMPLE * i + 8, height, true);
    });
    return view.buffer;
  };

  // Heights in m above rest; null if the message is not a frame.
  play.unpackFrame = function (buffer) {
    const view = new DataView(buffer);
    if (view.byteLength !== FRAME || view.getUint8(0) !== KIND) return null;
    const flags = view.getUint8(1);
    return {
      late: Boolean(flags & 1),
      starved: Boolean(flags & 2),
      frame: view.getUint32(4, true),
      human: view.getFloat32(8, true),
      robot: view.getFloat32(12, true),
      force: view.getFloat32(16, true),
      used: view.getUint32(20, true),
    };
  };
})();
