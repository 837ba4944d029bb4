//! Where do a benchmark's results go?

use std::path::PathBuf;

use super::arguments::Arguments;
use crate::cli::exit::{Exit, Failure};
use crate::cli::output::{Output, print_bytes, write_json};
use crate::report::{BenchReport, bench_csv, bench_page, bench_table};

/// Places that were checked before anything was measured.
pub struct Places {
    json: Option<Output>,
    csv: Option<Output>,
    page: Option<Output>,
}

impl Places {
    /// Checks that they can be written, and that none is another one or would overwrite what is read.
    pub fn open(arguments: &Arguments) -> Result<Self, Failure> {
        let inputs = [&arguments.read, &arguments.baseline, &arguments.resume];
        let mut taken: Vec<&PathBuf> = inputs.into_iter().flatten().collect();
        Ok(Self {
            json: Output::open_apart(arguments.json.json.as_ref(), &mut taken)?,
            csv: Output::open_apart(arguments.csv.as_ref(), &mut taken)?,
            page: Output::open_apart(arguments.report.as_ref(), &mut taken)?,
        })
    }

    /// Writes all of them, and the table where stdout has nothing else.
    pub fn write(self, report: &BenchReport) -> Result<(), Failure> {
        let all = [&self.json, &self.csv, &self.page];
        let mut all = all.iter();
        let table = !all.any(|output| matches!(output, Some(Output::Stdout)));
        if let Some(json) = self.json {
            write_json(json, report)?;
        }
        if let Some(csv) = self.csv {
            let bytes = bench_csv(report).map_err(|error| Failure::new(Exit::File, error))?;
            csv.write(&bytes)?;
        }
        if let Some(page) = self.page {
            page.write(bench_page(report).as_bytes())?;
        }
        match table {
            true => print_bytes(bench_table(report).as_bytes()),
            false => Ok(()),
        }
    }
}
