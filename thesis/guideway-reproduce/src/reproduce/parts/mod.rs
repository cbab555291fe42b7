//! Measures the parts of chapter 5: each function takes the session and fills its part of the
//! results.
//!
//! | module | table or figure |
//! |---|---|
//! | `most_paths` | table 5.1 |
//! | `views` | tables 5.2 and 5.3, figure 5.3 |
//! | `growth` | figures 5.4 and 5.5, layouts that change (section 6.1.1) |
//! | `pictures` | figures 5.1, 5.2, 5.3, 5.6 and 5.7 |
//! | `borders` | coverage at the borders of cells (section 4.3.3) |

pub(crate) mod borders;
pub(crate) mod growth;
pub(crate) mod most_paths;
pub(crate) mod pictures;
pub(crate) mod views;
