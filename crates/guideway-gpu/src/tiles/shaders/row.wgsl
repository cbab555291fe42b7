// What a thread keeps of its row of samples.

const PIXELS_A_WORD: u32 = 32u / SAMPLES_A_ROW;

// Samples that opaque paths have covered.
var<private> covered: Row;
