//! How does a bench report become a page that needs nothing but itself?

use std::fmt::Write as _;

use super::bench::BenchReport;
use super::bench_headlines::headlines;
use super::bench_plots::{anchor, figures};
use super::bench_table::{cells, group_title, heads, is_number};
use super::bench_words::{count, figure, groups, plain, records_only};
use super::page;
use super::plot::{escape, put};

/// The page.
pub fn page(report: &BenchReport) -> String {
    let mut page = page::begin("What one pipeline saves", "umber bench", &report.device);
    let said = headlines(report).into_iter();
    let said = said.map(|headline| (anchor(headline.row), headline.text));
    page::write_headlines(&mut page, said, page::UNDER_HEADLINES);
    page::write_figures(&mut page, "Charts", &figures(report));
    write_method(&mut page, report);
    page::write_machine(&mut page, &report.device, &report.machine, &report.program);
    write_rows(&mut page, report);
    page::end(&mut page);
    page
}

/// What was timed, what the words mean, what it does not say, and how to do it again.
fn write_method(page: &mut String, report: &BenchReport) {
    let method = &report.method;
    page.push_str("<h2>Method</h2>\n");
    let timed = match records_only(report) {
        true => "Command buffers are recorded and reset, and never submitted.",
        false => {
            "Each frame is recorded, submitted and waited for. record: the host's time to record the commands. \
             submit-to-idle: from the submission until the device is idle. gpu: between the device's timestamps \
             around the pass."
        }
    };
    let frames = format!(
        "At least {} that count, and further ones until each cell took {} s on average; a cell that took {} s gets no \
         further frame. They are spread over several fresh devices, one after the other; on \
         each, {} before them do not count. The cells of a group take turns, a frame each, in an order that each round draws anew.",
        count(method.rounds.into(), "frame"),
        figure(method.further_seconds),
        figure(method.cell_seconds),
        match method.warm_up {
            1 => "the frame".to_owned(),
            frames => format!("the {frames} frames"),
        },
    );
    let items = [
        ("timed", timed.to_owned()),
        ("frames", frames),
        ("figures", "Medians; ± MAD is the median distance from the median, unscaled.".to_owned()),
        ("of base", "The ratio to the base's frame of the same round, so that a clock that changes between rounds cancels: \
          the median of each device's median.".to_owned()),
        ("95 %", "The interval between two order statistics of the devices' medians, by the sign test: it assumes no \
          distribution, and fewer than 6 have none. What the frames of one device share, such as where its memory \
          lies, does not narrow it. Where frames or compiling take long there is one device, and the interval is \
          between its frames.".to_owned()),
        ("sorted", "All draws of a material follow each other: a switch a material.".to_owned()),
        ("shuffled", "Draws in an order by chance, the same for all modes: a switch before almost every draw.".to_owned()),
        ("nothing", "The frame of the harness without any draw: what the other rows contain that is not theirs.".to_owned()),
        ("same … again", "Binds before every draw what is bound already: the command without the change.".to_owned()),
        ("scenes", "tiny: triangles of about 8 pixels, the driver's cost. zoo: balls of the built-in materials \
          under four lamps, a user's cost. patches: squares of growing size, one a material, the single shader's \
          cost. null: nothing is rasterised. bare: triangles that read one uniform block and no record, a state \
          command's cost by itself; bare-storage: the same with a storage buffer in the set that no shader reads.".to_owned()),
        ("clock", report.program.clock.clone()),
        ("seed", method.seed.to_string()),
        ("heap", match plain(&method.heap).as_str() {
            "" => "As the C library has it.".to_owned(),
            told => format!("{told}: what a frame frees stays with the program, and is not asked for anew in the next."),
        }),
    ];
    page::write_items(page, &items);
    page.push_str("<h2>Limits</h2>\n<ul>\n");
    for limit in limits(report) {
        put!(page, "<li>{}</li>\n", escape(limit));
    }
    page.push_str("</ul>\n<h2>Again</h2>\n");
    put!(
        page,
        "<pre><code>{}</code></pre>\n",
        escape(&command(report))
    );
}

fn limits(report: &BenchReport) -> Vec<&'static str> {
    let mut limits = vec![
        "One device, one driver: another's ratios are other ratios.",
        "An interval tells how surely these frames know their median. It knows nothing of another day's clock, \
         heat or neighbours.",
        "One thread records, and one queue draws.",
    ];
    if report.device.kind == "cpu" {
        limits.push(
            "A CPU draws: ratios of driver work and of arithmetic are its own, and no graphics card's.",
        );
    }
    if records_only(report) {
        limits
            .push("Nothing is submitted: a driver that defers work to the submission seems fast.");
    }
    limits
}

/// What measures the same cells; a custom plan has them from options that no report keeps.
fn command(report: &BenchReport) -> String {
    let method = &report.method;
    let mut command = "umber bench".to_owned();
    if method.plan == "full" {
        command.push_str(" --full");
    }
    if records_only(report) {
        command.push_str(" --method vkoverhead");
    }
    put!(command, " --seed {} --json=again.json", method.seed);
    if method.plan == "custom" {
        command.push_str("   # and the options that chose the cells");
    }
    command
}

fn write_rows(page: &mut String, report: &BenchReport) {
    page.push_str("<h2>Rows</h2>\n<div class=\"wide\">\n<table>\n<thead>\n<tr>");
    let class = |column| {
        if is_number(column) {
            " class=\"number\""
        } else {
            ""
        }
    };
    let heads = heads(report);
    for (column, head) in heads.into_iter().enumerate() {
        put!(page, "<th{}>{}</th>", class(column), escape(head));
    }
    page.push_str("</tr>\n</thead>\n");
    for group in groups(report) {
        let title = group.first().map(|i| group_title(&report.rows[*i]));
        let title = escape(&title.unwrap_or_default());
        put!(
            page,
            "<tbody>\n<tr><th colspan=\"{}\">{title}</th></tr>\n",
            heads.len()
        );
        for i in group {
            let row = &report.rows[i];
            let kind = match row.samples {
                0 => " class=\"absent\"",
                _ if row.mode == row.base => " class=\"base\"",
                _ => "",
            };
            put!(page, "<tr id=\"{}\"{kind}>", anchor(i));
            for (column, cell) in cells(row).iter().enumerate() {
                put!(page, "<td{}>{}</td>", class(column), escape(cell));
            }
            page.push_str("</tr>\n");
        }
        page.push_str("</tbody>\n");
    }
    page.push_str("</table>\n</div>\n");
}
