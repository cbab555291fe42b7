//! Swept areas and distances against brute force.

mod brute;
mod clearance;
mod convex;
mod distance;
mod random;
mod swept;
