//! Writes the page from the sections: one HTML file without scripts or external resources.

use super::content::{Block, Section};
use crate::reproduce::{Finding, Picture, Run, Verdict};
use guideway_bench::Machine;
use guideway_bench::format::time;
use guideway_bench::page::{document, element, escape, facts};

/// The whole page, also valid XML, so that XML tools can check it.
pub(super) fn page(run: &Run, sections: &[Section]) -> String {
    let title = if run.plan.is_quick {
        "Guideway: the thesis reproduced in small"
    } else {
        "Guideway: the thesis reproduced"
    };
    let mut html = format!("<header>\n<h1>{title}</h1>\n");
    html += &header(run);
    html += "<nav><ol>\n";
    for section in sections {
        html += &format!(
            "<li><a href=\"#{}\">{}</a></li>\n",
            section.id,
            escape(section.title)
        );
    }
    html += "</ol></nav>\n</header>\n<main>\n";
    for section in sections {
        html += &format!(
            "<section id=\"{}\">\n{}",
            section.id,
            element("h2", section.title)
        );
        section.blocks.iter().for_each(|b| html += &block(b));
        html += "</section>\n";
    }
    html += "</main>\n";
    document(title, &html)
}

fn header(run: &Run) -> String {
    let mut html = String::new();
    if run.is_partial {
        html += &notice("Stopped before its end: this report holds the measurements so far.");
    }
    if run.plan.is_quick {
        html += &notice(
            "This is the quick run: fewer paths, smaller pictures and fewer frames than in the \
             thesis, for results within minutes even on a software graphics device. Compare its \
             numbers with each other, not with those of the thesis.",
        );
    }
    let machines = || run.sessions.iter().map(|session| &session.machine);
    if machines().any(|machine| machine.profile != "release") {
        html += &notice(
            "Compiled with the debug profile: times on the processor are longer than in a release \
             build.",
        );
    }
    let processors = unique(machines().map(Machine::processor));
    if processors.len() > 1 {
        html += &notice(
            "The sessions had different processors: their times on the processor are not \
             comparable.",
        );
    }
    let devices = run.methods.iter().filter_map(|m| m.device.clone());
    html += &facts(&[
        ("Measured", measured(run)),
        ("Processor", processors.join("; ")),
        (
            "System",
            unique(machines().map(|m| m.os.clone())).join("; "),
        ),
        ("Devices", unique(devices).join("; ")),
        (
            "Guideway",
            unique(machines().map(Machine::build)).join("; "),
        ),
    ]);
    html
}

fn measured(run: &Run) -> String {
    let started: Vec<&str> = run.sessions.iter().map(|s| s.started.as_str()).collect();
    let elapsed = time(run.elapsed_s() * 1e3);
    let took = match started.len() {
        0 | 1 => elapsed,
        several => format!("{several} sessions of {elapsed} in total"),
    };
    format!("{}, in {took}", started.join("; "))
}

/// Every value once, in the order of first occurrence.
fn unique(values: impl Iterator<Item = String>) -> Vec<String> {
    let mut unique = Vec::new();
    for value in values {
        if !unique.contains(&value) {
            unique.push(value);
        }
    }
    unique
}

fn notice(text: &str) -> String {
    format!("<p class=\"notice\">{}</p>\n", escape(text))
}

fn block(block: &Block) -> String {
    match block {
        Block::Text(text) => element("p", text),
        Block::Findings(findings) => findings.iter().map(finding).collect(),
        Block::Table(table) if table.rows.is_empty() => {
            element("p", &format!("{}: no measurements.", table.title))
        }
        Block::Table(table) => table.html(),
        Block::Chart(chart) if chart.is_empty() => {
            element("p", &format!("{}: no measurements.", chart.title))
        }
        Block::Chart(chart) => chart.html(),
        Block::Pictures(caption, pictures) if pictures.is_empty() => element(
            "p",
            &format!("{caption}: no method for it runs on this computer."),
        ),
        Block::Pictures(caption, pictures) => {
            let pictures: String = pictures.iter().map(picture).collect();
            let caption = escape(caption);
            format!(
                "<figure><figcaption>{caption}</figcaption>\n\
                 <div class=\"pictures\">\n{pictures}</div></figure>\n"
            )
        }
    }
}

fn finding(finding: &Finding) -> String {
    let (class, verdict) = match finding.verdict {
        Verdict::Holds => ("holds", "holds here"),
        Verdict::DoesNotHold => ("fails", "does not hold here"),
        Verdict::NotMeasured => ("unknown", "not measured"),
    };
    format!(
        "<article class=\"{class}\">\n<h3>{} <span class=\"verdict\">{verdict}</span></h3>\n\
         <blockquote>{} <cite>({})</cite></blockquote>\n<p>{}</p>\n</article>\n",
        escape(&finding.title),
        escape(&finding.claim),
        escape(&finding.section),
        escape(&finding.evidence),
    )
}

fn picture(picture: &Picture) -> String {
    let [width, height] = picture
        .size_px
        .map(|px| u64::from(px) * u64::from(picture.enlarged));
    let class = if picture.enlarged > 1 {
        " class=\"enlarged\""
    } else {
        ""
    };
    let caption = escape(&picture.caption);
    format!(
        "<figure><img{class} width=\"{width}\" height=\"{height}\" alt=\"{caption}\" \
         src=\"data:image/png;base64,{}\"/><figcaption>{caption}</figcaption></figure>\n",
        escape(&picture.png_base64)
    )
}
