// Cached lines lie in blocks: the lines that one workgroup flattened of a cluster. A header in the
// place of one line precedes each block:
//
//     | NO_LINE, previous block of the cluster, number of lines | line | line | ...
//                                                               ^ the block's number

const NO_BLOCK: u32 = 0u;
