//! The project's own commands: `cargo xtask COMMAND`.
//!
//! Results go to stdout, progress to stderr. What a command needs and the machine lacks is installed first, where apt
//! can do it; elsewhere the command says what to run.

mod accuracy;
mod adaptive;
mod board;
mod boards;
mod bus;
mod compare;
mod cost;
mod costs;
mod count;
mod cycles;
mod demo;
mod elf;
mod firmware;
mod gallery;
mod goals;
mod growth;
mod install;
mod oled;
mod process;
mod project;
mod qemu;
mod readme;
mod table;
mod teapot;
mod test;
mod toolchain;
mod ways;

use anyhow::Result;
use clap::{Parser, Subcommand};
use std::process::ExitCode;

#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", about = "The project's own commands", disable_help_subcommand = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

/// The commands: each is a module with its `Arguments` and its `run`.
#[derive(Subcommand)]
enum Command {
    Accuracy(accuracy::Arguments),
    Board(board::Arguments),
    Boards(boards::Arguments),
    Bus(bus::Arguments),
    Compare(compare::Arguments),
    Cost(cost::Arguments),
    Cycles(cycles::Arguments),
    Demo(demo::Arguments),
    Gallery(gallery::Arguments),
    Growth(growth::Arguments),
    Oled(oled::Arguments),
    Readme(readme::Arguments),
    Test(test::Arguments),
    Ways(ways::Arguments),
}

fn run(command: Command) -> Result<()> {
    match command {
        Command::Accuracy(arguments) => accuracy::run(&arguments),
        Command::Board(arguments) => board::run(&arguments),
        Command::Boards(arguments) => boards::run(&arguments),
        Command::Bus(_) => bus::run(),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Cost(arguments) => cost::run(&arguments),
        Command::Cycles(arguments) => cycles::run(&arguments),
        Command::Demo(arguments) => demo::run(&arguments),
        Command::Gallery(_) => gallery::run(),
        Command::Growth(_) => growth::run(),
        Command::Oled(arguments) => oled::run(&arguments),
        Command::Readme(arguments) => readme::run(&arguments),
        Command::Test(arguments) => test::run(&arguments),
        Command::Ways(_) => ways::run(),
    }
}

fn main() -> ExitCode {
    match run(Arguments::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}
