//! The network: a stem, blocks of a Conformer, and a layer that scores tokens.
//!
//! A. Gulati and others, "Conformer: Convolution-augmented Transformer for Speech Recognition", 2020. Each block is
//! half a feed-forward layer, attention over all frames, a convolution over neighbours, and another half feed-forward
//! layer.

use super::math::{Matrix, add, add_bias, gelu, normalised, sigmoid, silu, softmax};
use super::spectrum::{BINS, MELS};

/// The frames of the spectrum in a window of the stem, and from one window to the next.
const STEM: usize = 3;
pub(super) const STRIDE: usize = 2;

/// The sizes of a network.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct NetworkShape {
    /// The number of values per frame, and inside a feed-forward layer.
    pub(super) width: usize,
    pub(super) inner: usize,
    /// The number of frames in a convolution.
    pub(super) kernel: usize,
    pub(super) blocks: usize,
    pub(super) heads: usize,
    pub(super) tokens: usize,
}

impl NetworkShape {
    pub(super) const SIZES: usize = 7;

    /// Returns the shape with these sizes, or `None` if they are unsupported.
    pub(super) fn from_sizes([mels, width, inner, kernel, blocks, heads, tokens]: [usize; 7]) -> Option<NetworkShape> {
        let fits = mels == MELS
            && (1..=512).contains(&width)
            && (1..=4096).contains(&inner)
            && (1..=63).contains(&kernel)
            && kernel % 2 == 1
            && (1..=32).contains(&blocks)
            && heads > 0
            && width % heads == 0
            && (2..=4096).contains(&tokens);
        fits.then_some(NetworkShape { width, inner, kernel, blocks, heads, tokens })
    }

    pub(super) fn sizes(&self) -> [usize; NetworkShape::SIZES] {
        [MELS, self.width, self.inner, self.kernel, self.blocks, self.heads, self.tokens]
    }

    /// Returns the number of values of the network, including the bands of its spectrum.
    pub(super) fn numbers(&self) -> usize {
        let NetworkShape { width, inner, kernel, blocks, tokens, .. } = *self;
        let linear = |from: usize, to: usize| from * to + to;
        let feed = 2 * width + linear(width, inner) + linear(inner, width);
        let attention = 2 * width + linear(width, 3 * width) + linear(width, width);
        let convolution = 2 * width + linear(width, 2 * width) + linear(kernel, width) + linear(width, width);
        let block = 2 * feed + attention + convolution + 2 * width;
        BINS * MELS + linear(STEM * MELS, width) + blocks * block + linear(width, tokens)
    }
}

/// Returns the given number of next values, in the order of the file.
pub(super) type Take<'t> = dyn FnMut(usize) -> Vec<f32> + 't;

#[derive(Clone, Debug)]
struct LinearLayer {
    matrix: Matrix,
    bias: Vec<f32>,
}

impl LinearLayer {
    fn new(from: usize, to: usize, take: &mut Take<'_>) -> LinearLayer {
        LinearLayer { matrix: Matrix::new(from, to, &take(from * to)), bias: take(to) }
    }

    fn apply(&self, rows: &[f32]) -> Vec<f32> {
        let mut product = self.matrix.product(rows);
        add_bias(&mut product, &self.bias);
        product
    }
}

#[derive(Clone, Debug)]
struct Norm {
    scale: Vec<f32>,
    shift: Vec<f32>,
}

impl Norm {
    fn new(width: usize, take: &mut Take<'_>) -> Norm {
        Norm { scale: take(width), shift: take(width) }
    }

    fn apply(&self, rows: &[f32]) -> Vec<f32> {
        normalised(rows, &self.scale, &self.shift)
    }
}

#[derive(Clone, Debug)]
struct Feed {
    norm: Norm,
    up: LinearLayer,
    down: LinearLayer,
}

impl Feed {
    fn new(shape: &NetworkShape, take: &mut Take<'_>) -> Feed {
        let NetworkShape { width, inner, .. } = *shape;
        Feed {
            norm: Norm::new(width, take),
            up: LinearLayer::new(width, inner, take),
            down: LinearLayer::new(inner, width, take),
        }
    }

    fn apply(&self, rows: &[f32]) -> Vec<f32> {
        let mut inner = self.up.apply(&self.norm.apply(rows));
        inner.iter_mut().for_each(|number| *number = silu(*number));
        self.down.apply(&inner)
    }
}

#[derive(Clone, Debug)]
struct Block {
    first: Feed,
    attention_norm: Norm,
    attention_in: LinearLayer,
    attention_out: LinearLayer,
    convolution_norm: Norm,
    convolution_in: LinearLayer,
    /// By frame, value.
    neighbours: Vec<f32>,
    neighbours_bias: Vec<f32>,
    convolution_out: LinearLayer,
    second: Feed,
    norm: Norm,
}

impl Block {
    fn new(shape: &NetworkShape, take: &mut Take<'_>) -> Block {
        let width = shape.width;
        Block {
            first: Feed::new(shape, take),
            attention_norm: Norm::new(width, take),
            attention_in: LinearLayer::new(width, 3 * width, take),
            attention_out: LinearLayer::new(width, width, take),
            convolution_norm: Norm::new(width, take),
            convolution_in: LinearLayer::new(width, 2 * width, take),
            neighbours: take(shape.kernel * width),
            neighbours_bias: take(width),
            convolution_out: LinearLayer::new(width, width, take),
            second: Feed::new(shape, take),
            norm: Norm::new(width, take),
        }
    }

    fn apply(&self, shape: &NetworkShape, rows: &mut Vec<f32>) {
        let first = self.first.apply(rows);
        add(rows, &first, 0.5);
        let attended = self.attend(shape, rows);
        add(rows, &attended, 1.0);
        let convolved = self.convolve(shape, rows);
        add(rows, &convolved, 1.0);
        let second = self.second.apply(rows);
        add(rows, &second, 0.5);
        *rows = self.norm.apply(rows);
    }

    /// Returns each frame's attention to all others.
    fn attend(&self, shape: &NetworkShape, rows: &[f32]) -> Vec<f32> {
        let (width, size) = (shape.width, shape.width / shape.heads);
        let count = rows.len() / width;
        let all = self.attention_in.apply(&self.attention_norm.apply(rows));
        // The queries, keys and values of each frame, one after the other.
        let number = |frame: usize, part: usize, at: usize| all[frame * 3 * width + part * width + at];
        let scale = 1.0 / (size as f32).sqrt();
        let mut heard = vec![0.0; count * width];
        for head in (0..shape.heads).map(|head| head * size) {
            let query = |at: usize| number(at / size, 0, head + at % size) * scale;
            let queries: Vec<f32> = (0..count * size).map(query).collect();
            let keys = Matrix::of(size, count, |at, frame| number(frame, 1, head + at));
            let mut shares = keys.product(&queries);
            shares.chunks_exact_mut(count.max(1)).for_each(softmax);
            let values = Matrix::of(count, size, |frame, at| number(frame, 2, head + at));
            for (frame, value) in values.product(&shares).chunks_exact(size).enumerate() {
                heard[frame * width + head..][..size].copy_from_slice(value);
            }
        }
        self.attention_out.apply(&heard)
    }

    /// Returns the convolution of each frame with its neighbours.
    fn convolve(&self, shape: &NetworkShape, rows: &[f32]) -> Vec<f32> {
        let width = shape.width;
        let both = self.convolution_in.apply(&self.convolution_norm.apply(rows));
        let gate = |row: &[f32]| -> Vec<f32> {
            let (numbers, gates) = row.split_at(width);
            numbers.iter().zip(gates).map(|(number, gate)| number * sigmoid(*gate)).collect()
        };
        let gated: Vec<f32> = both.chunks_exact(2 * width).flat_map(gate).collect();
        let count = gated.len() / width;
        let mut sums = Vec::with_capacity(gated.len());
        for frame in 0..count {
            let mut sum = self.neighbours_bias.clone();
            for (tap, weights) in self.neighbours.chunks_exact(width).enumerate() {
                let Some(other) = (frame + tap).checked_sub(shape.kernel / 2).filter(|other| *other < count) else {
                    continue;
                };
                for ((sum, number), weight) in sum.iter_mut().zip(&gated[other * width..]).zip(weights) {
                    *sum += number * weight;
                }
            }
            sums.extend(sum.into_iter().map(silu));
        }
        self.convolution_out.apply(&sums)
    }
}

/// A network with its values.
#[derive(Clone, Debug)]
pub(super) struct Network {
    pub(super) shape: NetworkShape,
    /// The bands of the spectrum, by bin and band.
    pub(super) bands: Matrix,
    stem: LinearLayer,
    blocks: Vec<Block>,
    names: LinearLayer,
}

impl Network {
    pub(super) fn new(shape: NetworkShape, take: &mut Take<'_>) -> Network {
        let bands = Matrix::new(BINS, MELS, &take(BINS * MELS));
        let stem = LinearLayer::new(STEM * MELS, shape.width, take);
        let blocks = (0..shape.blocks).map(|_| Block::new(&shape, take)).collect();
        Network { shape, bands, stem, blocks, names: LinearLayer::new(shape.width, shape.tokens, take) }
    }

    /// Returns the likelihood of each token in each frame, as logarithms up to a constant. `spectrum` has `MELS` bands
    /// per frame, and every second frame produces an output frame.
    pub(super) fn run(&self, spectrum: &[f32]) -> Vec<f32> {
        let count = spectrum.len() / MELS;
        let mut windows = Vec::with_capacity(count.div_ceil(STRIDE) * STEM * MELS);
        for middle in (0..count).step_by(STRIDE) {
            for frame in middle..middle + STEM {
                let frame = frame.checked_sub(STEM / 2).filter(|frame| *frame < count);
                match frame.and_then(|frame| spectrum.get(frame * MELS..(frame + 1) * MELS)) {
                    Some(bands) => windows.extend_from_slice(bands),
                    None => windows.extend([0.0; MELS]),
                }
            }
        }
        let mut rows = self.stem.apply(&windows);
        rows.iter_mut().for_each(|number| *number = gelu(*number));
        self.blocks.iter().for_each(|block| block.apply(&self.shape, &mut rows));
        self.names.apply(&rows)
    }
}
