//! What a package installs beside the program: shell completions and the man page.

use std::io::Write;

use anyhow::Result;
use clap::{Args, CommandFactory};
use clap_complete::Shell;

use super::help::TOPICS;

#[derive(Args)]
pub struct Arguments {
    /// The shell that is to complete commands and options
    shell: Shell,
}

/// Writes the completion script of a shell.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<()> {
    // `generate` panics when a write fails, for example into a closed pipe: memory does not fail
    // so.
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut super::Arguments::command(), "riemap", &mut script);
    out.write_all(&script)?;
    Ok(())
}

/// Writes the man page: the program, every command with its options, and the topics of `riemap
/// help`.
pub fn man(out: &mut dyn Write) -> Result<()> {
    let mut program = super::Arguments::command();
    program.build();
    let mut page = Vec::new();
    clap_mangen::Man::new(program.clone()).render(&mut page)?;
    for command in program.get_subcommands().filter(|command| !command.is_hide_set()) {
        let man = clap_mangen::Man::new(command.clone());
        writeln!(page, ".SH \"RIEMAP {}\"", command.get_name().to_uppercase())?;
        man.render_description_section(&mut page)?;
        man.render_synopsis_section(&mut page)?;
        man.render_options_section(&mut page)?;
    }
    writeln!(page, ".SH TOPICS")?;
    for topic in TOPICS {
        writeln!(page, ".TP\n\\fBriemap help {}\\fR\n{}", topic.name.replace('-', "\\-"), topic.about)?;
    }
    out.write_all(&page)?;
    Ok(())
}
