//! `riemap help TOPIC`: reference texts, and the help of commands.

use std::io::Write;

use anyhow::{Result, bail};
use clap::{Args, CommandFactory};

#[derive(Args)]
pub struct Arguments {
    /// A topic or a command; without it, the topics are listed
    #[arg(value_name = "TOPIC")]
    topic: Option<String>,
}

/// A reference text.
pub struct Topic {
    /// The name under which it is asked for.
    pub name: &'static str,
    /// Its subject, in one line.
    pub about: &'static str,
    text: &'static str,
}

/// Every topic, in the order in which they are listed.
pub const TOPICS: &[Topic] = &[
    topic("maps", "which options give which map", include_str!("topics/maps.txt")),
    topic("formats", "mesh, volume and output formats", include_str!("topics/formats.txt")),
    topic("energies", "the terms of an energy and their weights", include_str!("topics/energies.txt")),
    topic("solvers", "direct and iterative solvers, and when they stop", include_str!("topics/solvers.txt")),
    topic("valid", "flipped faces, overlaps, and the maps that replace them", include_str!("topics/valid.txt")),
    topic("report", "the fields of the JSON report and its schema", include_str!("topics/report.txt")),
    topic("experiments", "experiment files and their results", include_str!("topics/experiments.txt")),
    topic("limits", "what Riemap does not do, or not well", include_str!("topics/limits.txt")),
    topic("bench", "how peers are compared", include_str!("topics/bench.txt")),
    topic("exit-codes", "exit codes and signals", include_str!("topics/exit-codes.txt")),
    topic("install", "shell completions and the man page", include_str!("topics/install.txt")),
];

const fn topic(name: &'static str, about: &'static str, text: &'static str) -> Topic {
    Topic { name, about, text }
}

pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<()> {
    let Some(name) = arguments.topic.as_deref() else {
        writeln!(out, "riemap help TOPIC, where TOPIC is a command or one of")?;
        for Topic { name, about, .. } in TOPICS {
            writeln!(out, "  {name:<12} {about}")?;
        }
        return Ok(());
    };
    if let Some(topic) = TOPICS.iter().find(|topic| topic.name == name) {
        write!(out, "{}", topic.text)?;
        return Ok(());
    }
    let mut program = super::Arguments::command();
    program.build();
    match program.find_subcommand_mut(name) {
        Some(command) => write!(out, "{}", command.render_long_help())?,
        None => {
            let names: Vec<&str> = TOPICS.iter().map(|topic| topic.name).collect();
            bail!("there is no topic or command `{name}`; topics are {}", names.join(", "));
        }
    }
    Ok(())
}
