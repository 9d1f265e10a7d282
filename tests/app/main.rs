//! The application: command line, experiments, figures, the page of results.

#![allow(clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;

mod batch;
mod command_line;
mod experiment;
mod figure;
mod figure_pictures;
mod figure_view;
mod hostile;
mod page;
mod rooms;
mod studies;
