//! How does a result leave the program for other programs, and for people?

mod bench;
mod bench_baseline;
mod bench_compare;
mod bench_csv;
mod bench_headlines;
mod bench_page;
mod bench_plots;
mod bench_table;
mod bench_words;
mod effects;
mod heat_map;
mod interval;
mod models;
mod page;
mod plot;
mod provenance;
mod render;
mod stability;
mod stability_page;
mod table;

pub use bench::{BenchReport, BenchRow, BreakEven, Method};
pub use bench_baseline::{BadBaseline, read as read_bench};
pub use bench_compare::{Change, Comparison, OtherDevice, compare};
pub use bench_csv::csv as bench_csv;
pub use bench_headlines::{Headline, headlines};
pub use bench_page::page as bench_page;
pub use bench_table::table as bench_table;
pub use effects::{BuildRow, EffectRow, EffectsReport};
pub use interval::Interval95;
pub use models::{ModelCase, ModelRow, ModelsReport};
pub use provenance::{Device, Machine, Program};
pub use render::{Image, RenderReport, SceneSize};
pub use stability::{BitsMap, CostRow, StabilityReport, StabilityRow, Summary};
pub use stability_page::page as stability_page;
pub use table::{Align, write_table};
