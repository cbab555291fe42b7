//! The end of a command whose panics do not unwind, as in the packages: tables for unwinding are an
//! eighth of a program.

use std::panic::{set_hook, take_hook};
use std::process::exit;

use guideway::formats::arrow::decode_panic;

use super::error::ERROR;
use super::output::Output;

/// The exit code of a panic that unwinds.
const PANIC: i32 = 101;

/// Lets a panic remove unfinished files. One of the Arrow library is the error of a damaged file.
pub(super) fn end_by_panic(out: Output) {
    let print = take_hook();
    set_hook(Box::new(move |panic| {
        guideway::try_remove_unfinished();
        if let Some(error) = decode_panic() {
            out.error(&error.into());
            exit(ERROR.into());
        }
        print(panic);
        exit(PANIC);
    }));
}
