// The module of the npm package for servers that have their layouts as Arrow: the element with the
// engine that reads nothing else.

// An element takes its engine when it is defined, so that comes after.
import "./use-arrow.js";
export * from "./exports.js";
