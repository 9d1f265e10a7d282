//! Help, reference topics, completions, the man page, and output for programs.

use serde_json::Value;

use super::shell::{Shell, hill};

#[test]
fn help_is_short_or_long_and_grouped() {
    let shell = Shell::new();
    let [short, long] = ["-h", "--help"].map(|option| shell.done(&["map", option]));
    for heading in ["Surface:", "Boundary and constraints:", "Energy:", "Quad graph:", "Solver:", "Output:", "Volumes:"]
    {
        assert!(short.contains(heading) && long.contains(heading), "{heading}");
    }
    let letters = |text: &str| text.chars().filter(|c| !c.is_whitespace()).count();
    assert!(letters(&short) < letters(&long));
    assert!(long.contains("energy H + C") && !short.contains("energy H + C"));
}

#[test]
fn every_topic_and_command_is_explained() {
    let shell = Shell::new();
    let list = shell.done(&["help"]);
    let topics: Vec<&str> = list.lines().skip(1).filter_map(|line| line.split_whitespace().next()).collect();
    assert!(topics.len() >= 8);
    for topic in topics.iter().chain(&["map", "info", "bench"]) {
        assert!(shell.done(&["help", topic]).len() > 200, "{topic}");
    }
    let message = shell.refused(&["help", "frobnicate"]);
    assert!(message.contains("frobnicate") && message.contains("energies"), "{message}");
}

#[test]
fn completions_and_the_man_page_know_commands_and_options() {
    let shell = Shell::new();
    for name in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = shell.done(&["completions", name]);
        assert!(script.contains("reproduce") && script.contains("max-iterations"), "{name}");
    }
    let page = shell.done(&["man"]);
    assert!(page.contains(".TH riemap 1") && page.contains("RIEMAP MAP") && page.contains("\\-\\-max\\-iterations"));
}

#[test]
fn info_and_list_speak_json() {
    let shell = Shell::new();
    shell.write("m.obj", hill(4, 1.0, false));
    let info: Value = serde_json::from_str(&shell.done(&["info", "m.obj", "--json", "--boundary"])).unwrap();
    assert_eq!((&info["kind"], &info["vertices"], &info["ready"]), (&"triangle".into(), &16.into(), &true.into()));
    assert_eq!(info["boundary"].as_array().unwrap().len(), 12);
    let component = &info["components"][0];
    assert_eq!((&component["genus"], &component["euler"]), (&0.into(), &1.into()));
    shell.write("far.obj", format!("{}v 9 9 9\nv 8 9 9\nv 9 8 9\nf 17 18 19\n", hill(4, 1.0, false)));
    let ran = shell.run(&["info", "far.obj", "--json"]);
    let info: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!((ran.code, &info["ready"]), (1, &false.into()));
    assert!(info["findings"].as_array().unwrap().iter().any(|finding| finding["severity"] == "problem"));
    let list: Value = serde_json::from_str(&shell.done(&["list", "--json"])).unwrap();
    assert!(list["energies"]["SD"].is_string() && list["constraints"]["square"].is_string());
}

/// A map that runs until it is stopped, long enough for a signal.
#[cfg(unix)]
fn stopped(shell: &Shell, signal: &str, options: &[&str]) -> i32 {
    use std::io::{BufRead, BufReader};
    use std::process::Stdio;
    shell.write("o.obj", "old");
    let mut arguments = vec!["map", "sphere?n=200&mesh=delaunay", "--energy", "H + A + L", "-o", "o.obj"];
    arguments.extend(options);
    let mut child = shell.command(&arguments).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(1500));
    let kill = std::process::Command::new("kill").args([signal, &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    let code = child.wait().unwrap().code().unwrap_or(-1);
    let said: Vec<String> = BufReader::new(child.stderr.take().unwrap()).lines().map(Result::unwrap).collect();
    assert!(!said.iter().any(|line| line.contains("panicked")), "{said:?}");
    code
}

#[cfg(unix)]
#[test]
fn a_stopped_map_keeps_the_old_file_unless_told_to_write() {
    for (signal, code) in [("-INT", 130), ("-TERM", 143), ("-HUP", 129)] {
        let shell = Shell::new();
        assert_eq!(stopped(&shell, signal, &[]), code);
        assert_eq!(shell.read("o.obj"), "old");
    }
    let shell = Shell::new();
    assert_eq!(stopped(&shell, "-TERM", &["--on-interrupt", "write"]), 143);
    assert!(shell.read("o.obj").contains("vt "));
}
