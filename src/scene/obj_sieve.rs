//! Is each line of an OBJ file sound? The guard that stands between the file and tobj.
//!
//! tobj 4.0.5 takes lines on trust: it panics on some indices, answers most faults without a line,
//! reads a polyline of three as a triangle, refuses a file for one accent in a comment, shifts
//! normals where some corners have none, and holds about 100 bytes for each face until an object
//! ends. So it is fed a stream of canonical lines only: `v x y z`, `vn x y z`, `f v//n v//n v//n`
//! with absolute indices that are in range, `o`, `usemtl`, `mtllib`. An object that grows large is
//! handed on in pieces (`PIECE`), which keeps tobj's own tables small. Normal 1 is zero and stands
//! for "none". Where pictures need them, texture coordinates pass too: `vt u v`, `f v/t/n`, with NaN
//! as the first, which stands for "none".

use std::cell::RefCell;
use std::collections::HashSet;
use std::io::{self, BufRead, Read, Write};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use indexmap::IndexMap;

use super::checks::FARTHEST;
use super::error::Error;
use super::models::MAX_OBJECTS;
use super::mtl;
use super::paths::{self, BYTE_ORDER_MARK};
use super::quote::{self, material_name, text};
use super::warnings::Warnings;

/// Faces after which tobj is told that a new object begins: its tables stay below 100 MB, and the
/// vertices that two pieces share, which it stores twice, are few.
const PIECE: usize = 1 << 18;
/// The longest line that is read: a polygon of a million corners. Binary data without a line's end
/// stops here.
const LONGEST_LINE: usize = 32 << 20;
/// Bytes that are made ready for tobj at once.
const BLOCK: usize = 1 << 16;
/// The most vertices, and one more than the most normals: a u32 numbers them, and one means "none".
const MOST_VERTICES: usize = u32::MAX as usize;

/// Texture coordinate 1.
const NO_COORDINATES: &[u8] = b"vt nan nan\n";

/// The MTL files that the OBJ names, in the order in which tobj will ask for them.
pub(super) type Libraries = Rc<RefCell<Vec<mtl::Library>>>;

/// The most names of MTL files in an OBJ: each one costs a look at the disk, found or not.
const MOST_LIBRARIES: usize = 1024;
/// The longest `mtllib` line, in bytes: sixteen of the longest paths that a system allows.
const LONGEST_NAMES: usize = 16 * 4096;

/// The MTL files that were named so far.
#[derive(Default)]
struct Named {
    /// Whole lines and single names as written.
    names: HashSet<String>,
    /// The files without links.
    files: HashSet<PathBuf>,
    /// Their size together.
    bytes: u64,
}

/// Reads an OBJ file and gives out its sound lines; stops at the first fault.
pub(super) struct Sieve<R> {
    source: R,
    path: PathBuf,
    folder: PathBuf,
    line: usize,
    raw: Vec<u8>,
    ready: Vec<u8>,
    taken: usize,
    ended: bool,
    positions: usize,
    normals: usize,
    coordinates: usize,
    /// Whether texture coordinates are passed on.
    keep: bool,
    /// True where a library with pictures came after what should have been passed on.
    pub(super) late: bool,
    faces: usize,
    faces_in_piece: usize,
    pieces: usize,
    object: String,
    libraries: Libraries,
    named: Named,
    /// The fault that ended the reading.
    pub(super) fault: Option<Error>,
    /// Materials that faces are given, with the line that first names each.
    pub(super) used: IndexMap<String, usize>,
    /// What was passed over.
    pub(super) warnings: Warnings,
}

impl<R: BufRead> Sieve<R> {
    /// Guards `source`, which holds the text of the file `path` and names MTL files in `folder`.
    /// `keep` passes texture coordinates on, as does an MTL file with pictures.
    pub(super) fn new(
        source: R,
        path: &Path,
        folder: &Path,
        libraries: Libraries,
        keep: bool,
    ) -> Self {
        // The normal and the coordinates that mean "none".
        let mut ready = b"vn 0 0 0\n".to_vec();
        if keep {
            ready.extend_from_slice(NO_COORDINATES);
        }
        Self {
            source,
            path: path.to_path_buf(),
            folder: folder.to_path_buf(),
            line: 0,
            raw: Vec::new(),
            ready,
            taken: 0,
            ended: false,
            positions: 0,
            normals: 0,
            coordinates: 0,
            keep,
            late: false,
            faces: 0,
            faces_in_piece: 0,
            pieces: 0,
            object: String::new(),
            libraries,
            named: Named::default(),
            fault: None,
            used: IndexMap::new(),
            warnings: Warnings::default(),
        }
    }

    /// The number of faces passed on.
    pub(super) fn faces(&self) -> usize {
        self.faces
    }

    /// The number of lines read.
    pub(super) fn lines(&self) -> usize {
        self.line
    }

    fn refuse(&self, message: impl Into<String>) -> Error {
        Error::line(&self.path, self.line, message)
    }

    /// Reads one line, joined with those that a backslash continues, unless it is a comment, which
    /// may end in a folder's name; false at the end.
    fn read_line(&mut self) -> Result<bool, Error> {
        self.raw.clear();
        loop {
            let room = (LONGEST_LINE - self.raw.len()) as u64;
            let read = self
                .source
                .by_ref()
                .take(room)
                .read_until(b'\n', &mut self.raw)
                .map_err(|error| Error::io(&self.path, &error))?;
            if read > 0 {
                self.line += 1;
            }
            if self.raw.len() >= LONGEST_LINE {
                return Err(self.refuse("the line is too long: this is not an OBJ file"));
            }
            if self.line == 1 && self.raw.starts_with(BYTE_ORDER_MARK) {
                self.raw.drain(..BYTE_ORDER_MARK.len());
            }
            let comment = self.raw.trim_ascii_start().starts_with(b"#");
            let end = self.raw.trim_ascii_end().len();
            if read == 0 || comment || end == 0 || self.raw[end - 1] != b'\\' {
                return Ok(read > 0 || !self.raw.is_empty());
            }
            self.raw.truncate(end - 1);
            self.raw.push(b' ');
        }
    }

    /// Passes on one line of the file; false at the end.
    fn step(&mut self) -> Result<bool, Error> {
        if !self.read_line()? {
            return Ok(false);
        }
        let raw = std::mem::take(&mut self.raw);
        let result = self.pass(&raw);
        self.raw = raw;
        result.map(|()| true)
    }

    fn pass(&mut self, raw: &[u8]) -> Result<(), Error> {
        let line = raw.trim_ascii();
        let split = line
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(line.len());
        let (keyword, rest) = (&line[..split], line[split..].trim_ascii());
        match keyword {
            b"v" => self.position(rest),
            b"vn" => self.normal(rest),
            b"vt" => self.coordinate(rest),
            b"f" => self.face(rest),
            b"o" | b"g" => {
                self.object = text(rest);
                self.begin_object();
                Ok(())
            }
            b"usemtl" => self.use_material(rest),
            b"mtllib" => self.material_libraries(rest),
            _ if line.contains(&0) => {
                Err(self.refuse("holds a zero byte: this is not an OBJ file"))
            }
            // Comments, lines, points, curves, smoothing groups.
            _ => Ok(()),
        }
    }

    fn position(&mut self, rest: &[u8]) -> Result<(), Error> {
        let values: Vec<&[u8]> = words(rest).take(4).collect();
        if values.len() < 3 {
            return Err(self.refuse("a vertex needs three coordinates"));
        }
        // Four values are homogeneous; more are a colour, which is not used.
        let weight = match (values.get(3), words(rest).count()) {
            (Some(word), 4) => self.number(word, "a vertex's weight")?,
            _ => 1.0,
        };
        if weight == 0.0 {
            return Err(self.refuse("a vertex of weight 0 is infinitely far away"));
        }
        let mut xyz = [0.0; 3];
        for (to, word) in xyz.iter_mut().zip(&values) {
            *to = self.number(word, "a coordinate")? / weight;
            if to.abs() > FARTHEST as f32 {
                let message = format!(
                    "the coordinate {} is farther than {FARTHEST:e} m from the origin",
                    shown(word)
                );
                return Err(self.refuse(message));
            }
        }
        self.positions += 1;
        if self.positions > MOST_VERTICES {
            return Err(self.refuse("has more than 4294967295 vertices: split the file"));
        }
        self.put_vector(b"v", &values[..3], weight, xyz);
        Ok(())
    }

    fn normal(&mut self, rest: &[u8]) -> Result<(), Error> {
        let values: Vec<&[u8]> = words(rest).take(3).collect();
        if values.len() < 3 {
            return Err(self.refuse("a normal needs three components"));
        }
        let mut xyz = [0.0; 3];
        for (to, word) in xyz.iter_mut().zip(&values) {
            *to = self.number(word, "a normal's component")?;
        }
        self.normals += 1;
        if self.normals >= MOST_VERTICES {
            return Err(self.refuse("has more than 4294967294 normals: split the file"));
        }
        if xyz == [0.0; 3] {
            self.warn("a normal without a direction: the triangles' own stand in for it");
        }
        self.put_vector(b"vn", &values, 1.0, xyz);
        Ok(())
    }

    fn coordinate(&mut self, rest: &[u8]) -> Result<(), Error> {
        // A third is the depth in a solid texture.
        let values: Vec<&[u8]> = words(rest).take(2).collect();
        let Some(u) = values.first() else {
            return Err(self.refuse("a texture coordinate needs two numbers"));
        };
        for word in &values {
            let value = self.number(word, "a texture coordinate")?;
            if value.abs() > FARTHEST as f32 {
                let word = shown(word);
                let message = format!("the texture coordinate {word} is above {FARTHEST:e}");
                return Err(self.refuse(message));
            }
        }
        self.coordinates += 1;
        if self.coordinates >= MOST_VERTICES {
            let message = "has more than 4294967294 texture coordinates: split the file";
            return Err(self.refuse(message));
        }
        if self.keep {
            self.ready.extend_from_slice(b"vt ");
            self.ready.extend_from_slice(u);
            self.ready.push(b' ');
            self.ready
                .extend_from_slice(values.get(1).copied().unwrap_or(b"0"));
            self.ready.push(b'\n');
        }
        Ok(())
    }

    /// Three numbers as the file writes them, unless a weight changed them.
    fn put_vector(&mut self, keyword: &[u8], words: &[&[u8]], weight: f32, xyz: [f32; 3]) {
        self.ready.extend_from_slice(keyword);
        for (word, value) in words.iter().zip(xyz) {
            self.ready.push(b' ');
            if weight == 1.0 {
                self.ready.extend_from_slice(word);
            } else {
                self.ready.extend_from_slice(value.to_string().as_bytes());
            }
        }
        self.ready.push(b'\n');
    }

    fn number(&self, word: &[u8], what: &str) -> Result<f32, Error> {
        let parsed = std::str::from_utf8(word)
            .ok()
            .and_then(|word| word.parse().ok());
        match parsed {
            Some(value) if f32::is_finite(value) => Ok(value),
            Some(_) => {
                let word = shown(word);
                Err(self.refuse(format!("{what} is {word}: NaN and infinity have no place")))
            }
            None => Err(self.refuse(format!("'{}' is not a number", shown(word)))),
        }
    }

    fn face(&mut self, rest: &[u8]) -> Result<(), Error> {
        let start = self.ready.len();
        self.ready.push(b'f');
        let mut corners = 0;
        for corner in words(rest) {
            let [vertex, coordinate, normal] = self.corner(corner)?;
            self.ready.push(b' ');
            put_index(&mut self.ready, vertex);
            self.ready.push(b'/');
            if self.keep {
                put_index(&mut self.ready, coordinate);
            }
            self.ready.push(b'/');
            put_index(&mut self.ready, normal);
            corners += 1;
        }
        if corners < 3 {
            self.ready.truncate(start);
            return Err(self.refuse(format!(
                "a face needs three vertices, this one has {corners}"
            )));
        }
        self.ready.push(b'\n');
        // A polygon of n corners becomes n - 2 triangles.
        self.faces += corners - 2;
        self.faces_in_piece += corners - 2;
        if self.faces_in_piece >= PIECE {
            self.begin_object();
        }
        if self.pieces > MAX_OBJECTS {
            let message = format!("begins more than {MAX_OBJECTS} objects or changes of material");
            return Err(self.refuse(message));
        }
        Ok(())
    }

    /// A face's corner `v`, `v/vt`, `v//vn` or `v/vt/vn` as absolute numbers: the vertex from 1,
    /// and coordinates and normal from 2, where 1 means none.
    fn corner(&self, corner: &[u8]) -> Result<[usize; 3], Error> {
        let mut parts = corner.split(|&byte| byte == b'/');
        let vertex = parts.next().unwrap_or_default();
        let vertex = self.index(vertex, corner, self.positions, "vertex", "vertices")?;
        let coordinate = match parts.next() {
            None | Some(b"") => 1,
            Some(word) => {
                let (count, one) = (self.coordinates, "texture coordinate");
                1 + self.index(word, corner, count, one, "texture coordinates")?
            }
        };
        let normal = match parts.next() {
            None | Some(b"") => 1,
            Some(normal) => 1 + self.index(normal, corner, self.normals, "normal", "normals")?,
        };
        match parts.next() {
            None => Ok([vertex, coordinate, normal]),
            Some(_) => Err(self.refuse(format!("'{}' is not a face's corner", shown(corner)))),
        }
    }

    /// An index from 1, or counted back from the last by a negative one, of `count` so far.
    fn index(
        &self,
        word: &[u8],
        corner: &[u8],
        count: usize,
        one: &str,
        many: &str,
    ) -> Result<usize, Error> {
        let parsed = std::str::from_utf8(word)
            .ok()
            .and_then(|word| word.parse().ok());
        let Some(index): Option<i64> = parsed else {
            return Err(self.refuse(format!("'{}' is not a face's corner", shown(corner))));
        };
        let absolute = if index < 0 {
            index
                .saturating_add_unsigned(count as u64)
                .saturating_add(1)
        } else {
            index
        };
        match usize::try_from(absolute) {
            Ok(absolute) if (1..=count).contains(&absolute) => Ok(absolute),
            _ if index == 0 => Err(self.refuse(format!("a face names {one} 0: they count from 1"))),
            _ => Err(self.refuse(format!(
                "a face names {one} {index}, out of range: {count} {many} stand before this line"
            ))),
        }
    }

    /// tobj ends its model at a new object or material, and keeps some hundred bytes for each.
    fn end_piece(&mut self) {
        self.pieces += usize::from(self.faces_in_piece > 0);
        self.faces_in_piece = 0;
    }

    fn begin_object(&mut self) {
        self.end_piece();
        self.ready.extend_from_slice(b"o ");
        self.ready.extend_from_slice(self.object.as_bytes());
        self.ready.push(b'\n');
    }

    fn warn(&mut self, message: &str) {
        let place = quote::path(&self.path);
        self.warnings
            .push(format!("{place}:{}: {message}", self.line));
    }

    fn use_material(&mut self, rest: &[u8]) -> Result<(), Error> {
        let name = material_name(rest).map_err(|fault| self.refuse(format!("usemtl: {fault}")))?;
        if name.is_empty() {
            self.warn("usemtl without a name");
        }
        self.end_piece();
        self.ready.extend_from_slice(b"usemtl ");
        // tobj refuses an empty name; this one is in no file, since names there are trimmed text.
        self.ready.extend_from_slice(if name.is_empty() {
            b"\x01"
        } else {
            name.as_bytes()
        });
        self.ready.push(b'\n');
        if !name.is_empty() {
            self.used.entry(name).or_insert(self.line);
        }
        Ok(())
    }

    /// Loads the MTL files of a `mtllib` line. The whole line is one name if such a file exists
    /// (names with spaces are common), else each word is one.
    fn material_libraries(&mut self, rest: &[u8]) -> Result<(), Error> {
        if rest.is_empty() {
            self.warn("mtllib without a name");
            return Ok(());
        }
        if rest.len() > LONGEST_NAMES {
            return Err(self.refuse("mtllib: the line is longer than 64 KiB"));
        }
        let whole = quote::whole(rest);
        // Many files repeat the line for each object.
        if self.named.names.contains(&whole) {
            return Ok(());
        }
        if whole.contains(char::is_whitespace) && !self.folder.join(&whole).exists() {
            for name in whole.split_whitespace() {
                self.material_library(name)?;
            }
            self.named.names.insert(whole);
            Ok(())
        } else {
            self.material_library(&whole)
        }
    }

    /// Loads the MTL file `name`, unless that was done before.
    fn material_library(&mut self, name: &str) -> Result<(), Error> {
        if !self.named.names.insert(name.to_owned()) {
            return Ok(());
        }
        if self.named.names.len() > MOST_LIBRARIES {
            let message = format!("names more than {MOST_LIBRARIES} material libraries");
            return Err(self.refuse(message));
        }
        let shown = quote::short(name);
        let refuse =
            |sieve: &Self, message: String| sieve.refuse(format!("mtllib {shown}: {message}"));
        let found = paths::inside(&self.folder, name).map_err(|fault| refuse(self, fault))?;
        let Some(found) = found else {
            let message = format!(
                "mtllib {shown}: no such file; its materials become '{}'",
                super::materials::DEFAULT_NAME
            );
            self.warn(&message);
            return Ok(());
        };
        if !self.named.files.insert(found.real) {
            return Ok(());
        }
        let file = paths::open(&found.path).map_err(|fault| refuse(self, fault.into_message()))?;
        let library = mtl::load(&found.path, file, mtl::LARGEST - self.named.bytes)?;
        self.named.bytes += library.bytes;
        if !self.keep && library.maps.iter().any(|maps| !maps.is_empty()) {
            if self.coordinates == 0 && self.faces == 0 {
                self.keep = true;
                self.ready.extend_from_slice(NO_COORDINATES);
            } else {
                self.late = true;
            }
        }
        self.libraries.borrow_mut().push(library);
        self.ready.extend_from_slice(b"mtllib next\n");
        Ok(())
    }
}

impl<R: BufRead> Read for Sieve<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let ready = self.fill_buf()?;
        let count = ready.len().min(buffer.len());
        buffer[..count].copy_from_slice(&ready[..count]);
        self.consume(count);
        Ok(count)
    }
}

impl<R: BufRead> BufRead for Sieve<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.taken == self.ready.len() && !self.ended {
            self.ready.clear();
            self.taken = 0;
            while self.ready.len() < BLOCK && !self.ended {
                match self.step() {
                    Ok(more) => self.ended = !more,
                    Err(fault) => {
                        self.fault = Some(fault);
                        self.ended = true;
                        return Err(io::Error::other("the file is at fault"));
                    }
                }
            }
        }
        Ok(&self.ready[self.taken..])
    }

    fn consume(&mut self, count: usize) {
        self.taken = (self.taken + count).min(self.ready.len());
    }
}

fn words(rest: &[u8]) -> impl Iterator<Item = &[u8]> {
    rest.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
        .take_while(|word| word[0] != b'#')
}

/// Bytes as a message quotes them.
fn shown(bytes: &[u8]) -> String {
    quote::short(&text(bytes))
}

fn put_index(to: &mut Vec<u8>, index: usize) {
    // Writing to memory cannot fail.
    let _ = write!(to, "{index}");
}
