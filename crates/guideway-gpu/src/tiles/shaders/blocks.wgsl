// Lines that are kept lie in blocks, those that one workgroup has made of a cluster: so they are found again when an edit has
// touched it. Before them is what takes the place of a line. Its words say that it is none, which block of the cluster was made
// before, and how many lines follow. The number of a block is where its lines begin.

const NO_BLOCK: u32 = 0u;
