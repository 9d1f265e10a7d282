//! Syntax highlighting of configs: comments, tables, keys and strings.

use super::html::escape;

/// `toml` as HTML for a `<pre>`. Whatever the text, tags taken away it is the text again.
pub(super) fn highlight(toml: &str) -> String {
    let mut html = String::new();
    // The quotes of a string over several lines.
    let mut open: Option<&str> = None;
    for (at, text) in toml.split('\n').enumerate() {
        html.push_str(if at == 0 { "" } else { "\n" });
        let Some(quotes) = open else {
            html.push_str(&line(text));
            let code = &text[..comment_start(text)];
            open = ["\"\"\"", "'''"].into_iter().find(|quotes| code.matches(*quotes).count() % 2 == 1);
            continue;
        };
        let end = text.find(quotes).map(|at| at + quotes.len());
        let (inside, rest) = text.split_at(end.unwrap_or(text.len()));
        mark(&mut html, "s", inside);
        html.push_str(&line(rest));
        open = if end.is_some() { None } else { open };
    }
    html
}

fn line(line: &str) -> String {
    let (code, comment) = line.split_at(comment_start(line));
    let mut html = String::new();
    // A table stands alone on its line; an array of arrays goes on after its bracket.
    let heading = code.starts_with('[') && code.trim_end().ends_with(']');
    if heading && !code.contains(',') {
        mark(&mut html, "t", code);
    } else {
        let (key, value) = code.split_at(assignment(code).unwrap_or(0));
        mark(&mut html, "k", key);
        let mut rest = value;
        while let Some((from, to)) = string(rest) {
            html.push_str(&escape(&rest[..from]));
            mark(&mut html, "s", &rest[from..to]);
            rest = &rest[to..];
        }
        html.push_str(&escape(rest));
    }
    mark(&mut html, "c", comment);
    html
}

fn mark(html: &mut String, class: &str, text: &str) {
    if !text.is_empty() {
        html.push_str(&format!("<span class=\"{class}\">{}</span>", escape(text)));
    }
}

/// The position at which the comment of a line begins, or the end of the line.
fn comment_start(line: &str) -> usize {
    outside_strings(line, '#').unwrap_or(line.len())
}

/// The position of the `=` after the key of a line.
fn assignment(code: &str) -> Option<usize> {
    // What begins otherwise is the inside of an array.
    let key = code.starts_with(|c: char| c.is_ascii_alphanumeric() || "\"'_-".contains(c));
    if key { outside_strings(code, '=') } else { None }
}

/// The position of the first `wanted` of a line outside of strings.
fn outside_strings(line: &str, wanted: char) -> Option<usize> {
    let mut from = 0;
    loop {
        let rest = &line[from..];
        let found = rest.find(wanted);
        match string(rest) {
            Some((begin, end)) if found.is_some_and(|at| begin < at) => from += end,
            _ => return found.map(|at| from + at),
        }
    }
}

/// The first string of a line, quotes included; to the end of the line where it is not closed
/// there.
fn string(text: &str) -> Option<(usize, usize)> {
    let from = text.find(['"', '\''])?;
    let quote = text[from..].chars().next()?;
    let mut escaped = false;
    for (at, c) in text[from + 1..].char_indices() {
        if c == quote && !escaped {
            return Some((from, from + 1 + at + 1));
        }
        escaped = quote == '"' && c == '\\' && !escaped;
    }
    Some((from, text.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_tables_keys_and_strings_are_told_apart() {
        assert_eq!(highlight("[map]  # <H>"), "<span class=\"t\">[map]  </span><span class=\"c\"># &lt;H&gt;</span>");
        assert_eq!(
            highlight("\"a.b=#\" = [\"x # y\", 3] # z"),
            "<span class=\"k\">&quot;a.b=#&quot; </span>= [<span class=\"s\">&quot;x # y&quot;</span>, 3] \
             <span class=\"c\"># z</span>"
        );
        assert_eq!(highlight("a = \"\"\"\nb = # c\nd\"\"\" # e").matches("class=\"c\"").count(), 1);
        assert_eq!(highlight("    [\"k\", \"l\"],").matches("class=\"s\"").count(), 2);
        assert_eq!(highlight("a = \"q\\\" # no comment\"").matches("class=\"c\"").count(), 0);
    }

    #[test]
    fn without_tags_it_is_the_text_again_however_damaged() {
        for toml in
            ["", "[", "\"", "'\\'#", "é = \"ü\\", "= # = \"", "a\n\n\tb = '''x\ny''' # z", "[a]\u{301}=\"]#\"", "<b>&"]
        {
            let mut html = highlight(toml);
            while let (Some(from), Some(to)) = (html.find('<'), html.find('>')) {
                html.replace_range(from..=to, "");
            }
            let text = html.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&#39;", "'");
            assert_eq!(text.replace("&amp;", "&"), toml);
        }
    }
}
