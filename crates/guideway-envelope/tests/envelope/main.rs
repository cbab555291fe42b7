//! Compares swept areas, distances and clearance checks with brute force.

mod areas;
mod brute;
mod clearance;
mod convex;
mod distance;
mod limits;
mod random;
mod swept;
