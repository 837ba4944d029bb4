//! Which meshes does a Wavefront OBJ file hold, and of what are they made?
//!
//! Faces become triangles, polygons as fans about their first corner (right for convex ones).
//! Triangles without an area are dropped, with a warning: they cover nothing and have no normal.
//! Lines, points, curves and smoothing groups are passed over; where normals are missing, `normals`
//! makes them. Texture coordinates are kept where some material may have a picture; in a piece where
//! some corners have none, these get (0, 0), with a warning.

use std::cell::Cell;
use std::collections::HashSet;
use std::io::{BufReader, Read};
use std::ops::Range;
use std::path::Path;

use indexmap::IndexMap;
use indicatif::{ProgressBar, ProgressStyle};

use super::description::MaterialText;
use super::error::Error;
use super::materials::DEFAULT_NAME;
use super::mesh::Mesh;
use super::normals::{self, Surface, TooManyVertices};
use super::obj_sieve::{Libraries, Sieve};
use super::warnings::Warnings;
use super::{mtl, paths, quote};

/// What an OBJ file and its MTL files hold.
pub(super) struct ObjFile {
    /// One mesh for each object and material.
    pub pieces: Vec<Piece>,
    /// Materials by their names in the MTL.
    pub materials: IndexMap<String, MaterialText>,
    pub warnings: Vec<String>,
}

/// Triangles of one object and one material.
pub(super) struct Piece {
    pub mesh: Mesh,
    /// The name of its material in the MTL; None for the default.
    pub material: Option<String>,
}

/// Files from this size on show a progress bar: smaller ones load in less than a second.
const PROGRESS_BYTES: u64 = 16 << 20;

/// Loads an OBJ file, and the MTL files that it names from `folder`. `progress` shows a bar on stderr
/// for large ones, if it is a terminal. `coordinates` keeps texture coordinates although no MTL file
/// has a picture.
pub(super) fn load(
    path: &Path,
    folder: &Path,
    progress: bool,
    coordinates: bool,
) -> Result<ObjFile, Error> {
    match load_once(path, folder, progress, coordinates)? {
        Some(file) => Ok(file),
        // The MTL file with pictures was named after the coordinates: once more, with them.
        None => load_once(path, folder, progress, true)?
            .ok_or_else(|| Error::file(path, "changes while it is read: try again")),
    }
}

/// As above; None where coordinates are needed that were not kept.
fn load_once(
    path: &Path,
    folder: &Path,
    progress: bool,
    coordinates: bool,
) -> Result<Option<ObjFile>, Error> {
    let file = paths::open(path)?;
    let size = file
        .metadata()
        .map_err(|error| Error::io(path, &error))?
        .len();
    if size == 0 {
        return Err(Error::file(path, "is empty"));
    }
    let bar = if progress && size > PROGRESS_BYTES {
        progress_bar(size)
    } else {
        ProgressBar::hidden()
    };
    let result = read(path, folder, bar.wrap_read(file), coordinates);
    bar.finish_and_clear();
    result
}

fn progress_bar(bytes: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("loading {bar:40} {bytes}/{total_bytes} {eta}");
    let bar = ProgressBar::new(bytes);
    match style {
        Ok(style) => bar.with_style(style),
        // The default style serves as well.
        Err(_) => bar,
    }
}

/// Reads the text of an OBJ file; `path` is for messages, `folder` holds its MTL files.
fn read(
    path: &Path,
    folder: &Path,
    source: impl Read,
    coordinates: bool,
) -> Result<Option<ObjFile>, Error> {
    let libraries = Libraries::default();
    let mut sieve = Sieve::new(
        BufReader::with_capacity(1 << 18, source),
        path,
        folder,
        libraries.clone(),
        coordinates,
    );
    let options = tobj::LoadOptions {
        single_index: true,
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
    };
    let next = Cell::new(0);
    let loaded = tobj::load_obj_buf(&mut sieve, &options, |_| {
        let number = next.replace(next.get() + 1);
        let mut libraries = libraries.borrow_mut();
        let materials = libraries
            .get_mut(number)
            .map_or(Vec::new(), |library| std::mem::take(&mut library.materials));
        let numbers = materials.iter().enumerate();
        let map = numbers
            .map(|(i, material)| (material.name.clone(), i))
            .collect();
        Ok((materials, map))
    });
    if let Some(fault) = sieve.fault.take() {
        return Err(fault);
    }
    let (models, materials) =
        loaded.map_err(|error| Error::file(path, quote::message(&error.to_string())))?;
    let materials =
        materials.map_err(|error| Error::file(path, quote::message(&error.to_string())))?;
    if sieve.faces() == 0 {
        let message = format!(
            "has no faces in its {} lines: there is nothing to draw",
            sieve.lines()
        );
        return Err(Error::file(path, message));
    }
    if sieve.late {
        return Ok(None);
    }
    let mut warnings = std::mem::take(&mut sieve.warnings);
    let names: Vec<String> = materials.iter().map(|m| m.name.clone()).collect();
    warn_of_unknown(path, &sieve.used, &names, &mut warnings);
    drop(sieve);
    let pieces = assemble(path, models, &names, &mut warnings)?;
    let mut warnings = warnings.into_text();
    let mut maps = Vec::new();
    for library in libraries.borrow_mut().iter_mut() {
        warnings.append(&mut library.warnings);
        maps.append(&mut library.maps);
    }
    // tobj keeps one material for each `newmtl`, in the order of the lines.
    let all = materials.iter().zip(&maps);
    let text = all.map(|(material, maps)| (material.name.clone(), mtl::convert(material, maps)));
    Ok(Some(ObjFile {
        pieces,
        materials: text.collect(),
        warnings,
    }))
}

/// Tells of the materials that faces are given and no MTL file has.
fn warn_of_unknown(
    path: &Path,
    used: &IndexMap<String, usize>,
    names: &[String],
    warnings: &mut Warnings,
) {
    let known: HashSet<&str> = names.iter().map(String::as_str).collect();
    for (name, line) in used
        .iter()
        .filter(|(name, _)| !known.contains(name.as_str()))
    {
        let (place, name) = (quote::path(path), quote::short(name));
        warnings.push(format!(
            "{place}:{line}: no MTL has a material '{name}'; its faces become '{DEFAULT_NAME}'"
        ));
    }
}

/// An object and its material's number in the MTL.
type Key = (String, Option<usize>);

/// Joins tobj's models into one surface, makes normals, and cuts it by object and material.
fn assemble(
    path: &Path,
    models: Vec<tobj::Model>,
    names: &[String],
    warnings: &mut Warnings,
) -> Result<Vec<Piece>, Error> {
    let too_many =
        |_: TooManyVertices| Error::file(path, "has more than 4294967295 vertices: split the file");
    let (mut surface, runs, dropped) = join(models).map_err(too_many)?;
    if dropped > 0 {
        warnings.push(format!(
            "{}: {dropped} triangles have no area and are left out",
            quote::path(path)
        ));
    }
    if surface.indices.is_empty() {
        return Err(Error::file(
            path,
            "has no face with an area: there is nothing to draw",
        ));
    }
    normals::fill_missing(&mut surface, normals::CREASE_DEGREES).map_err(too_many)?;
    let meshes = cut(surface, &runs);
    let pieces = runs
        .into_keys()
        .zip(meshes)
        .filter_map(|((name, material), mut mesh)| {
            mesh.name = name;
            if let Some(missing) = settle(&mut mesh.coordinates) {
                let (path, name) = (quote::path(path), quote::short(&mesh.name));
                warnings.push(format!(
                    "{path}: {missing} vertices of '{name}' have no texture coordinates, others \
                     have: they get 0 0"
                ));
            }
            let material = material.and_then(|number| names.get(number).cloned());
            (!mesh.indices.is_empty()).then_some(Piece { mesh, material })
        });
    Ok(pieces.collect())
}

/// Where in `indices` the triangles of an object and material stand.
type Runs = IndexMap<Key, Vec<Range<usize>>>;

/// Puts the models one after another, each freed as soon as it is taken over. Also counts the
/// triangles without an area, which are left out.
fn join(models: Vec<tobj::Model>) -> Result<(Surface, Runs, usize), TooManyVertices> {
    let vertices: usize = models.iter().map(|m| m.mesh.positions.len() / 3).sum();
    let corners: usize = models.iter().map(|m| m.mesh.indices.len()).sum();
    // The last number is kept free: it marks "none".
    if vertices >= u32::MAX as usize || corners >= u32::MAX as usize {
        return Err(TooManyVertices);
    }
    let mut surface = Surface {
        positions: Vec::with_capacity(vertices),
        normals: Vec::with_capacity(vertices),
        indices: Vec::with_capacity(corners),
        coordinates: Vec::new(),
    };
    let mut runs = Runs::new();
    let mut dropped = 0;
    for tobj::Model { mesh, name } in models {
        let base = surface.positions.len() as u32;
        let start = surface.indices.len();
        let (positions, _) = mesh.positions.as_chunks::<3>();
        surface.positions.extend_from_slice(positions);
        let (given, _) = mesh.normals.as_chunks::<3>();
        surface
            .normals
            .extend(given.iter().map(|&normal| normals::unit(normal)));
        let (coordinates, _) = mesh.texcoords.as_chunks::<2>();
        surface.coordinates.extend_from_slice(coordinates);
        for &triangle in mesh.indices.as_chunks::<3>().0 {
            let corners = triangle.map(|vertex| positions[vertex as usize]);
            if normals::face_normal(corners) == glam::DVec3::ZERO {
                dropped += 1;
            } else {
                surface.indices.extend(triangle.map(|vertex| vertex + base));
            }
        }
        let run = start..surface.indices.len();
        runs.entry((name, mesh.material_id)).or_default().push(run);
    }
    Ok((surface, runs, dropped))
}

/// One mesh for each entry of `runs`, with the vertices that it uses.
fn cut(surface: Surface, runs: &Runs) -> Vec<Mesh> {
    let mut numbers = vec![u32::MAX; surface.positions.len()];
    if runs.len() == 1 && uses_all(&surface, &mut numbers) {
        return vec![Mesh {
            name: String::new(),
            positions: surface.positions,
            normals: surface.normals,
            indices: surface.indices,
            coordinates: surface.coordinates,
            ..Mesh::default()
        }];
    }
    numbers.fill(u32::MAX);
    let mut meshes = Vec::with_capacity(runs.len());
    for ranges in runs.values() {
        let mut mesh = Mesh::default();
        let mut taken = Vec::new();
        mesh.indices
            .reserve_exact(ranges.iter().map(Range::len).sum());
        for &vertex in ranges
            .iter()
            .flat_map(|range| &surface.indices[range.clone()])
        {
            let number = &mut numbers[vertex as usize];
            if *number == u32::MAX {
                *number = taken.len() as u32;
                taken.push(vertex);
            }
            mesh.indices.push(*number);
        }
        let at = |list: &[[f32; 3]]| taken.iter().map(|&v| list[v as usize]).collect();
        mesh.positions = at(&surface.positions);
        mesh.normals = at(&surface.normals);
        if !surface.coordinates.is_empty() {
            let list = &surface.coordinates;
            mesh.coordinates = taken.iter().map(|&v| list[v as usize]).collect();
        }
        // Set back what this mesh used, and no more: there may be many meshes.
        for &vertex in &taken {
            numbers[vertex as usize] = u32::MAX;
        }
        meshes.push(mesh);
    }
    meshes
}

/// Takes the marks of "none" out of a mesh's coordinates; the number of those that became 0. A mesh
/// where all have none has none.
fn settle(coordinates: &mut Vec<[f32; 2]>) -> Option<usize> {
    let is_none = |pair: &[f32; 2]| pair[0].is_nan();
    let missing = coordinates.iter().filter(|pair| is_none(pair)).count();
    if missing == coordinates.len() {
        *coordinates = Vec::new();
        return None;
    }
    for pair in coordinates.iter_mut().filter(|pair| is_none(pair)) {
        *pair = [0.0; 2];
    }
    (missing > 0).then_some(missing)
}

/// True where every vertex belongs to a triangle; marks them in `numbers`.
fn uses_all(surface: &Surface, numbers: &mut [u32]) -> bool {
    for &vertex in &surface.indices {
        numbers[vertex as usize] = 0;
    }
    numbers.iter().all(|&number| number == 0)
}
