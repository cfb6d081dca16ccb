//! Reads the files of an acoustic model of CMU Sphinx, except for phones in context.
//!
//! The formats are those of SphinxTrain: `s3` files with a text header, then numbers in the byte order of a mark.

use crate::Failure;
use std::fs;
use std::path::Path;

/// The byte order mark.
const BYTE_ORDER: u32 = 0x1122_3344;

/// A phonetically tied model without its triphones.
#[derive(Debug)]
pub(super) struct Model {
    /// The names of the phones, in the order of the file.
    pub(super) phones: Vec<String>,
    pub(super) streams: usize,
    /// The number of Gaussians in each stream of each phone.
    pub(super) densities: usize,
    /// The number of dimensions in the vector of a stream.
    pub(super) dimensions: usize,
    /// By phone, stream, Gaussian, dimension.
    pub(super) means: Vec<f32>,
    pub(super) variances: Vec<f32>,
    /// By state (three per phone), stream, Gaussian: the negative logarithm of the weight, in steps of 1024 · ln
    /// 1.0001.
    pub(super) weights: Vec<u8>,
    /// The probability of staying, by state.
    pub(super) stay: Vec<f32>,
}

impl Model {
    pub(super) const STATES: usize = 3;

    pub(super) fn read(folder: &Path) -> Result<Model, Failure> {
        let read = |name: &str| fs::read(folder.join(name)).map_err(|error| format!("`{name}`: {error}"));
        let phones = phones(&mut File { name: "mdef", rest: &read("mdef")? })?;
        let (shape, means) = gaussians(&mut File { name: "means", rest: &read("means")? })?;
        let (same_shape, variances) = gaussians(&mut File { name: "variances", rest: &read("variances")? })?;
        let [codebooks, streams, densities, dimensions] = shape;
        if shape != same_shape || codebooks != phones.len() {
            return Err("the files are not of one model".to_owned());
        }
        let states = phones.len() * Self::STATES;
        let weights = weights(&mut File { name: "sendump", rest: &read("sendump")? }, [streams, densities, states])?;
        let stay = stay(&mut File { name: "transition_matrices", rest: &read("transition_matrices")? }, phones.len())?;
        Ok(Model { phones, streams, densities, dimensions, means, variances, weights, stay })
    }
}

/// Reads the names of the phones from a model definition in its binary form.
fn phones(file: &mut File<'_>) -> Result<Vec<String>, Failure> {
    if file.take(4)? != b"BMDF" || file.number()? != 1 {
        return Err(file.fault("not a binary model definition"));
    }
    let description = file.number()?;
    file.take(description)?;
    let count = file.number()?;
    file.take(9 * 4)?;
    (0..count).map(|_| file.name_of_phone()).collect()
}

/// Reads the numbers of codebooks, streams, densities and dimensions, and the values in this order.
fn gaussians(file: &mut File<'_>) -> Result<([usize; 4], Vec<f32>), Failure> {
    file.skip_header()?;
    let (codebooks, streams, densities) = (file.number()?, file.number()?, file.number()?);
    let dimensions = file.number()?;
    for _ in 1..streams {
        if file.number()? != dimensions {
            return Err(file.fault("streams of several lengths"));
        }
    }
    let count = file.number()?;
    if count != codebooks * streams * densities * dimensions {
        return Err(file.fault("a wrong number of numbers"));
    }
    let numbers = (0..count).map(|_| file.float()).collect::<Result<_, _>>()?;
    Ok(([codebooks, streams, densities, dimensions], numbers))
}

/// Reads the weights of the first `states` states, by state, stream, density. The file has them by stream, density,
/// state.
fn weights(file: &mut File<'_>, [streams, densities, states]: [usize; 3]) -> Result<Vec<u8>, Failure> {
    loop {
        match file.number()? {
            0 => break,
            length => file.take(length)?,
        };
    }
    if file.number()? != densities {
        return Err(file.fault("other densities than the means"));
    }
    let all_states = file.number()?;
    let mut weights = vec![0; states * streams * densities];
    for stream in 0..streams {
        for density in 0..densities {
            for (state, &weight) in file.take(all_states)?.iter().take(states).enumerate() {
                weights[(state * streams + stream) * densities + density] = weight;
            }
        }
    }
    Ok(weights)
}

/// Reads the probability of staying in each state, from counts of transitions.
fn stay(file: &mut File<'_>, phones: usize) -> Result<Vec<f32>, Failure> {
    file.skip_header()?;
    let (matrices, from, to, _) = (file.number()?, file.number()?, file.number()?, file.number()?);
    if matrices != phones || from != Model::STATES || to != Model::STATES + 1 {
        return Err(file.fault("other states than three per phone"));
    }
    let mut stay = Vec::with_capacity(phones * from);
    for _ in 0..matrices {
        for state in 0..from {
            let row = (0..to).map(|_| file.float()).collect::<Result<Vec<_>, _>>()?;
            stay.push(row[state] / row.iter().sum::<f32>());
        }
    }
    Ok(stay)
}

/// The unread part of a file.
struct File<'a> {
    name: &'static str,
    rest: &'a [u8],
}

impl<'a> File<'a> {
    fn fault(&self, what: &str) -> Failure {
        format!("`{}`: {what}", self.name)
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], Failure> {
        let (taken, rest) = self.rest.split_at_checked(count).ok_or_else(|| self.fault("ends too early"))?;
        self.rest = rest;
        Ok(taken)
    }

    fn four(&mut self) -> Result<[u8; 4], Failure> {
        let fault = self.fault("ends too early");
        self.take(4)?.try_into().map_err(|_| fault)
    }

    fn number(&mut self) -> Result<usize, Failure> {
        let number = u32::from_le_bytes(self.four()?);
        usize::try_from(number).map_err(|_| self.fault("a number too large"))
    }

    fn float(&mut self) -> Result<f32, Failure> {
        Ok(f32::from_le_bytes(self.four()?))
    }

    fn name_of_phone(&mut self) -> Result<String, Failure> {
        let length = self.rest.iter().position(|&byte| byte == 0).ok_or_else(|| self.fault("a name without end"))?;
        let name = String::from_utf8_lossy(self.take(length)?).into_owned();
        self.take(1)?;
        Ok(name)
    }

    /// Skips the text at the start of an `s3` file and the byte order mark, which must match this machine.
    fn skip_header(&mut self) -> Result<(), Failure> {
        const END: &[u8] = b"endhdr\n";
        let end = self.rest.windows(END.len()).position(|window| window == END);
        self.take(end.ok_or_else(|| self.fault("no header"))? + END.len())?;
        match u32::from_le_bytes(self.four()?) {
            BYTE_ORDER => Ok(()),
            _ => Err(self.fault("another byte order")),
        }
    }
}
