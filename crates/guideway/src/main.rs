//! The `guideway` command.

#[global_allocator]
static ALLOCATOR: guideway::cli::Allocator = guideway::cli::Allocator;

fn main() -> std::process::ExitCode {
    guideway::cli::main()
}
