//! How is a group measured so that a second run agrees: on several devices, one after the other?
//!
//! On one device a ratio repeats to a percent; on the next, with its memory elsewhere, it may be three percent away.
//! An interval from the frames of one device does not hold that of another.

use super::measure::{Frames, Turn, visit, why_not};
use super::plan::{Cell, Group};
use super::rows::{Beside, Measured, row};
use super::stages::Scenes;
use super::{BenchError, Options};
use crate::gpu::Device;
use crate::render::Renderer;
use crate::report::BenchRow;

/// The visits to a group so far.
pub struct Visits<'a> {
    group: &'a Group,
    options: &'a Options,
    scenes: Scenes,
    /// Visit by visit.
    done: Vec<Vec<Frames>>,
    /// What the device cannot draw, and why.
    impossible: Vec<(Cell, String)>,
}

impl<'a> Visits<'a> {
    /// None yet; the group's scenes are made for devices like this one.
    ///
    /// # Errors
    /// A scene is beyond such a device.
    pub fn new(
        device: &Device,
        group: &'a Group,
        options: &'a Options,
    ) -> Result<Self, BenchError> {
        check_records(device, group)?;
        let kind = device.info().kind;
        Ok(Self {
            group,
            options,
            scenes: Scenes::new(kind, group, options)?,
            done: Vec::new(),
            impossible: Vec::new(),
        })
    }

    /// How many more there are to be.
    pub fn left(&self) -> u32 {
        self.group.visits(self.options.rounds) - self.done.len() as u32
    }

    /// Draws the group on a device that did nothing else before. `progress` hears of each frame.
    ///
    /// # Errors
    /// The device cannot, a mode records other commands than it says or leaves another picture, or the driver fails.
    pub fn visit(&mut self, renderer: &Renderer, progress: &dyn Fn(u64)) -> Result<(), BenchError> {
        let turn = Turn {
            number: self.done.len() as u32,
            visits: self.group.visits(self.options.rounds),
            options: self.options,
            scenes: &self.scenes,
        };
        self.done
            .push(visit(renderer, self.group, &turn, progress)?);
        let cells = self.group.cells.iter();
        let impossible = cells.filter_map(|cell| {
            let why = why_not(cell.mode, renderer.device())?;
            Some((*cell, why))
        });
        self.impossible = impossible.collect();
        Ok(())
    }

    /// The rows of the group's cells, in their order.
    pub fn rows(&self) -> Vec<BenchRow> {
        let cells = self.group.cells.iter();
        cells.map(|cell| self.row(cell)).collect()
    }

    fn row(&self, cell: &Cell) -> BenchRow {
        let own = self.of(|other| other == cell);
        let base = self.of(|other| other.mode.name == cell.mode.base && other.order == cell.order);
        let measured = own.first().map(|first| Measured {
            visits: own
                .iter()
                .zip(&base)
                .map(|(own, base)| Beside {
                    own: &own.samples,
                    base: &base.samples,
                })
                .collect(),
            made: first.made,
            counts: first.counts.clone(),
            hash: first.hash.clone(),
        });
        let mut notes = own.first().map_or(Vec::new(), |own| own.notes.clone());
        let why = self.impossible.iter().filter(|(other, _)| other == cell);
        notes.extend(why.map(|(_, why)| why.clone()));
        let timing = self.options.timing;
        row(
            self.group,
            cell,
            self.scenes.size(),
            measured,
            notes,
            timing,
        )
    }

    /// What each visit saw of a cell.
    fn of(&self, is: impl Fn(&Cell) -> bool) -> Vec<&Frames> {
        let all = self.done.iter().flatten();
        all.filter(|frames| is(&frames.cell)).collect()
    }
}

/// An object's record for each draw must fit what a shader may see.
fn check_records(device: &Device, group: &Group) -> Result<(), BenchError> {
    let bytes = u64::from(group.draws) * size_of::<crate::interface::Instance>() as u64;
    let limit = device.max_storage_bytes();
    if bytes > limit {
        return Err(BenchError::TooManyDraws {
            draws: group.draws,
            bytes,
            most: limit / size_of::<crate::interface::Instance>() as u64,
        });
    }
    let (width, height) = group.wall(group.materials, 0).size();
    let draws = group.draws;
    let size = device.check_target_size(width, height);
    size.map_err(|error| BenchError::TooLarge { draws, error })
}
