// The npm package: the element with the whole engine.

// An element takes its engine when it is defined, so that comes after.
import "./use-threads.js";
export * from "./exports.js";
