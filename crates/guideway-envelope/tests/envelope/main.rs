//! Swept areas and distances against brute force.

mod areas;
mod brute;
mod clearance;
mod convex;
mod distance;
mod random;
mod swept;
