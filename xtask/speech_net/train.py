"""Trains the recogniser of phones on synthetic speech.

usage: train.py DATA_FOLDER OUT_FILE MINUTES [START_FILE]

DATA_FOLDER has the shards of speak.py. START_FILE is a network to start from, with a lower rate. The network is a Conformer (A. Gulati and others, 2020) as in
`crates/lipz-speech/src/neural`, trained with CTC (A. Graves and others, 2006). Next to it, a second layer learns the
phone of each frame, which makes CTC converge faster; it is not exported. Each time that an utterance is used, its
spectrum is changed at random: vocal tract, level, tilt, room, noise, other voices, gaps.
"""

import math
import sys
import time
from pathlib import Path

import numpy as np
import torch
import torch.nn.functional as F
from torch import nn

import texts

MELS, WINDOW, HOP, RATE_HZ = 80, 400, 160, 16_000
STRIDE = 2
WIDTH, INNER, KERNEL, BLOCKS, HEADS = 96, 288, 15, 5, 4
PHONES = len(texts.PHONES)
# Tokens of CTC: the phones, a pause, and the blank.
PAUSE, BLANK, TOKENS = PHONES, PHONES + 1, PHONES + 2
# Pauses in the text of CTC last so many frames of ten milliseconds.
SHORTEST_PAUSE = 12
# The mean and the spread of the features.
CENTRE, SPREAD = -6.0, 4.0
FLOOR = 1e-10


def mel_bands():
    """Returns the bands of the spectrum by bin and band: triangles from 0 to 8,000 hertz, equally wide in mel."""
    mel = lambda hz: 2595 * np.log10(1 + hz / 700)
    edges = 700 * (10 ** (np.linspace(mel(20), mel(8000), MELS + 2) / 2595) - 1)
    bins = np.arange(WINDOW // 2 + 1) * RATE_HZ / WINDOW
    rising = (bins[:, None] - edges[None, :-2]) / (edges[1:-1] - edges[:-2])
    falling = (edges[None, 2:] - bins[:, None]) / (edges[2:] - edges[1:-1])
    bands = np.maximum(0, np.minimum(rising, falling))
    # The lowest bands are narrower than a bin: each takes the nearest one.
    for band in np.flatnonzero(bands.sum(0) < 0.5):
        bands[:, band] = 0
        bands[np.argmin(np.abs(bins - edges[band + 1])), band] = 1
    return (bands / bands.sum(0)).astype(np.float16).astype(np.float32)


def powers(samples, bands):
    """Returns the power of each band, every ten milliseconds, as `spectrum.rs` does."""
    padded = np.pad(samples.astype(np.float32) / 32768, WINDOW // 2, mode="reflect")
    windows = np.lib.stride_tricks.sliding_window_view(padded, WINDOW)[::HOP]
    hann = (0.5 - 0.5 * np.cos(2 * np.pi * np.arange(WINDOW) / WINDOW)).astype(np.float32)
    spectrum = np.fft.rfft(windows * hann, axis=1)
    return ((spectrum.real ** 2 + spectrum.imag ** 2) @ bands).astype(np.float32)


def read(folder, bands):
    """Returns the utterances: powers, and the phone of each frame."""
    utterances = []
    for path in sorted(Path(folder).glob("*[0-9].npz")):
        shard = np.load(path)
        sound, starts, phones = shard["sound"], shard["starts"], shard["phones"]
        for number in range(len(starts) - 1):
            spectrum = powers(sound[starts[number]:starts[number + 1]], bands)
            labels = np.zeros(len(spectrum), dtype=np.int64)
            start = 0
            for _, phone, end_ms in phones[phones[:, 0] == number]:
                end = min(len(labels), round(end_ms / 10))
                labels[start:end] = phone
                start = end
            utterances.append((spectrum, labels))
    return utterances


def runs(labels):
    """Returns the phones of these frames, each once, with pauses."""
    changes = np.flatnonzero(np.diff(labels, prepend=-1))
    lengths = np.diff(changes, append=len(labels))
    return [(labels[at], length) for at, length in zip(changes, lengths)]


def transcript(labels):
    """Returns the tokens of CTC."""
    tokens = []
    for label, length in runs(labels):
        if label > 0:
            tokens.append(label - 1)
        elif length >= SHORTEST_PAUSE and tokens and tokens[-1] != PAUSE:
            tokens.append(PAUSE)
    return tokens


class Changes:
    """Random changes of a spectrum."""

    def __init__(self, utterances, random):
        self.utterances, self.random = utterances, random
        mel = np.linspace(2595 * math.log10(1 + 20 / 700), 2595 * math.log10(1 + 8000 / 700), MELS + 2)[1:-1]
        self.hz = 700 * (10 ** (mel / 2595) - 1)
        self.mel = mel

    def warped(self, spectrum):
        """Changes the size of the vocal tract, as `features/warp.rs` does."""
        factor = self.random.uniform(0.72, 1.3)
        limit = min(4800, 4800 / factor)
        slope = (8000 - limit * factor) / (8000 - limit)
        hz = np.where(self.hz <= limit, self.hz * factor, limit * factor + (self.hz - limit) * slope)
        place = np.clip(np.interp(2595 * np.log10(1 + hz / 700), self.mel, np.arange(MELS)), 0, MELS - 1.001)
        below = place.astype(int)
        share = (place - below).astype(np.float32)
        logs = np.log(spectrum + FLOOR)
        return np.exp(logs[:, below] * (1 - share) + logs[:, below + 1] * share)

    def tilt(self, range_db):
        """Returns a smooth random filter."""
        knots = self.random.uniform(-range_db, range_db, 5)
        return (10 ** (np.interp(np.arange(MELS), np.linspace(0, MELS - 1, 5), knots) / 10)).astype(np.float32)

    def noise(self, count):
        """Returns the power of noise that is constant or changes slowly."""
        level = np.repeat(self.random.normal(0, self.random.choice([0, 3]), count // 40 + 2), 40)[:count]
        chi = self.random.gamma(1.2, 1 / 1.2, (count, MELS))
        return (self.tilt(15) * chi * (10 ** (level / 10))[:, None]).astype(np.float32)

    def room(self, spectrum):
        """Adds late reverberation: power that decays."""
        decay = np.exp(-13.8 * 0.01 / self.random.uniform(0.2, 0.9))
        wet = self.random.uniform(0.05, 0.5)
        out = spectrum.copy()
        tail = np.zeros(MELS, dtype=np.float32)
        for at, frame in enumerate(spectrum):
            tail = tail * decay + frame * (1 - decay)
            out[at] = frame * (1 - wet) + tail * wet * 2
        return out

    def __call__(self, number):
        random = self.random
        spectrum, labels = self.utterances[number]
        # Silence of a room before and after the speech.
        before, after = (int(random.integers(0, 60)) for _ in range(2))
        spectrum = np.pad(spectrum, ((before, after), (0, 0)))
        labels = np.pad(labels, (before, after))
        if random.random() < 0.85:
            spectrum = self.warped(spectrum)
        if random.random() < 0.3:
            spectrum = self.room(spectrum)
        spectrum = spectrum * self.tilt(6)
        voice = np.quantile(spectrum.sum(1), 0.9) + FLOOR
        snr_db = random.choice([random.uniform(5, 25), random.uniform(25, 60)])
        noise = self.noise(len(spectrum))
        spectrum = spectrum + noise * (voice / noise.sum(1).mean() * 10 ** (-snr_db / 10))
        if random.random() < 0.15:
            other, _ = self.utterances[int(random.integers(len(self.utterances)))]
            other = np.resize(other, spectrum.shape)
            share = voice / (np.quantile(other.sum(1), 0.9) + FLOOR)
            spectrum = spectrum + other * share * 10 ** (-random.uniform(12, 25) / 10)
        spectrum = spectrum * 10 ** (random.uniform(-25, 10) / 10)
        logs = np.log(np.maximum(spectrum, FLOOR)).astype(np.float32)
        for _ in range(int(random.integers(0, 3))):
            band, width = int(random.integers(MELS)), int(random.integers(1, 12))
            logs[:, band:band + width] = logs.mean()
        return logs, labels


class Feed(nn.Sequential):
    def __init__(self):
        super().__init__(
            nn.LayerNorm(WIDTH), nn.Linear(WIDTH, INNER), nn.SiLU(), nn.Linear(INNER, WIDTH))


class Block(nn.Module):
    def __init__(self):
        super().__init__()
        self.first, self.second = Feed(), Feed()
        self.attention_norm = nn.LayerNorm(WIDTH)
        self.attention_in, self.attention_out = nn.Linear(WIDTH, 3 * WIDTH), nn.Linear(WIDTH, WIDTH)
        self.convolution_norm = nn.LayerNorm(WIDTH)
        self.convolution_in, self.convolution_out = nn.Linear(WIDTH, 2 * WIDTH), nn.Linear(WIDTH, WIDTH)
        self.neighbours = nn.Conv1d(WIDTH, WIDTH, KERNEL, padding=KERNEL // 2, groups=WIDTH)
        self.norm = nn.LayerNorm(WIDTH)

    def forward(self, rows, mask):
        rows = rows + 0.5 * self.first(rows)
        batch, count, _ = rows.shape
        parts = self.attention_in(self.attention_norm(rows)).view(batch, count, 3, HEADS, WIDTH // HEADS)
        query, key, value = parts.permute(2, 0, 3, 1, 4)
        heard = F.scaled_dot_product_attention(query, key, value, attn_mask=mask[:, None, None, :])
        rows = rows + self.attention_out(heard.transpose(1, 2).reshape(batch, count, WIDTH))
        gated = F.glu(self.convolution_in(self.convolution_norm(rows))) * mask[:, :, None]
        around = self.neighbours(gated.transpose(1, 2)).transpose(1, 2)
        rows = rows + self.convolution_out(F.silu(around))
        rows = rows + 0.5 * self.second(rows)
        return self.norm(rows)


class Network(nn.Module):
    def __init__(self):
        super().__init__()
        self.stem = nn.Conv1d(MELS, WIDTH, 3, stride=STRIDE, padding=1)
        self.blocks = nn.ModuleList(Block() for _ in range(BLOCKS))
        self.names = nn.Linear(WIDTH, TOKENS)
        self.frames = nn.Linear(WIDTH, PHONES + 1)

    def forward(self, logs, lengths):
        rows = F.gelu(self.stem(((logs - CENTRE) / SPREAD).transpose(1, 2)).transpose(1, 2))
        mask = torch.arange(rows.shape[1])[None, :] < ((lengths + 1) // STRIDE)[:, None]
        for block in self.blocks:
            rows = block(rows, mask)
        return self.names(rows), self.frames(rows), mask


def batches(changes, random, frames=3_000):
    """Yields batches of utterances of similar length, in random order."""
    lengths = np.array([len(labels) for _, labels in changes.utterances])
    order = np.argsort(lengths + random.uniform(0, 40, len(lengths)))
    groups, group, most = [], [], 0
    for number in order:
        most = max(most, lengths[number] + 60)
        if group and most * (len(group) + 1) > frames:
            groups.append(group)
            group, most = [], lengths[number] + 60
        group.append(number)
    groups.append(group)
    random.shuffle(groups)
    for group in groups:
        yield [changes(number) for number in group]


def tensors(batch):
    longest = max(len(labels) for _, labels in batch)
    pad = lambda rows, value: np.pad(
        rows, ((0, longest - len(rows)),) + ((0, 0),) * (rows.ndim - 1), constant_values=value)
    logs = torch.from_numpy(np.stack([pad(logs, CENTRE) for logs, _ in batch]))
    labels = torch.from_numpy(np.stack([pad(labels, -1)[::STRIDE] for _, labels in batch]))
    return logs, labels, torch.tensor([len(labels) for _, labels in batch])


def phone_errors(network, utterances):
    """Returns the share of wrong phones on utterances without changes."""
    network.eval()
    wrong = total = 0
    with torch.no_grad():
        for spectrum, labels in utterances:
            logs = np.log(np.maximum(spectrum, FLOOR)).astype(np.float32)
            names, _, _ = network(torch.from_numpy(logs)[None], torch.tensor([len(logs)]))
            best = names[0].argmax(1).numpy()
            found = [token for token, _ in runs(best) if token < PHONES]
            said = [token for token in transcript(labels) if token < PHONES]
            row = list(range(len(found) + 1))
            for at, token in enumerate(said):
                diagonal, row[0] = row[0], at + 1
                for column, other in enumerate(found):
                    diagonal, row[column + 1] = row[column + 1], min(
                        diagonal + (token != other), row[column] + 1, row[column + 1] + 1)
            wrong, total = wrong + row[-1], total + len(said)
    network.train()
    return wrong / max(total, 1)


def main():
    folder, out, minutes = sys.argv[1], Path(sys.argv[2]), float(sys.argv[3])
    # Layers are too small for more threads.
    torch.set_num_threads(1)
    torch.manual_seed(1)
    random = np.random.default_rng(1)
    bands = mel_bands()
    utterances = read(folder, bands)
    random.shuffle(utterances)
    held, utterances = utterances[:60], utterances[60:]
    hours = sum(len(labels) for _, labels in utterances) / 360_000
    network = Network()
    count = sum(parameter.numel() for parameter in network.parameters())
    print(f"{len(utterances)} utterances, {hours:.2f} hours, {count} parameters", flush=True)
    peak = 2e-3
    if len(sys.argv) > 4:
        network.load_state_dict(torch.load(sys.argv[4])["state"])
        peak = 1.2e-3
    optimizer = torch.optim.AdamW(network.parameters(), lr=peak, betas=(0.9, 0.98), weight_decay=1e-3)
    started, step, total = time.time(), 0, None
    average = {name: value.clone() for name, value in network.state_dict().items()}
    while True:
        losses = []
        for batch in batches(Changes(utterances, random), random):
            passed = (time.time() - started) / 60 / minutes
            if passed >= 1:
                break
            rate = peak * min(1, step / 300) * (0.5 + 0.5 * math.cos(math.pi * passed))
            for group in optimizer.param_groups:
                group["lr"] = rate
            logs, labels, lengths = tensors(batch)
            names, frames, mask = network(logs, lengths)
            transcripts = [transcript(labels) for _, labels in batch]
            targets = torch.tensor([token for tokens in transcripts for token in tokens])
            ctc = F.ctc_loss(
                F.log_softmax(names, 2).transpose(0, 1), targets, (lengths + 1) // STRIDE,
                torch.tensor([len(tokens) for tokens in transcripts]), blank=BLANK, zero_infinity=True)
            framed = F.cross_entropy(frames.transpose(1, 2), labels[:, :frames.shape[1]], ignore_index=-1)
            loss = ctc + 0.5 * framed
            optimizer.zero_grad()
            loss.backward()
            nn.utils.clip_grad_norm_(network.parameters(), 2.0)
            optimizer.step()
            step += 1
            keep = min(0.998, step / (step + 20))
            for name, value in network.state_dict().items():
                average[name].mul_(keep).add_(value, alpha=1 - keep)
            losses.append((ctc.item(), framed.item()))
        else:
            print(f"{(time.time() - started) / 60:.1f} min, step {step}: ctc {np.mean([l[0] for l in losses]):.3f}, "
                  f"frames {np.mean([l[1] for l in losses]):.3f}, held {phone_errors(network, held):.3f}", flush=True)
            torch.save({"state": average, "bands": torch.from_numpy(bands)}, out)
            continue
        break
    network.load_state_dict(average)
    print(f"step {step}, held {phone_errors(network, held):.3f}", flush=True)
    torch.save({"state": average, "bands": torch.from_numpy(bands)}, out)


if __name__ == "__main__":
    main()
