// The sample row of a thread.

// import: shared/capsule.wgsl

const PIXELS_PER_WORD: u32 = 32u / SAMPLES_PER_ROW;

// Samples that opaque paths cover.
var<private> covered: SampleRow;
