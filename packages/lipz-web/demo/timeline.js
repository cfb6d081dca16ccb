// The timeline of a clip: its segments, how far the mouth is open in each frame, and the playhead.

import { openness } from "./mouth.js";

/** Draws a clip, and gives the functions that move the playhead and mark a segment. */
export function timeline(element, clip, locale, seek) {
  const segments = row("segments");
  for (const segment of clip.segments) {
    const part = document.createElement("div");
    part.className = "segment";
    part.style.flex = `${segment.endFrame - segment.startFrame} 1 0`;
    const events = document.createElement("small");
    events.textContent = segment.event || "\u00A0";
    part.append(segment.text(locale)?.text || "\u00A0", events);
    segments.append(part);
  }
  const frames = row("frames");
  for (const viseme of clip.frames) {
    const bar = document.createElement("div");
    bar.className = "frame";
    bar.style.height = `${8 + 88 * openness(viseme, clip.visemeType)}%`;
    frames.append(bar);
  }
  const playhead = row("playhead");
  element.replaceChildren(segments, frames, playhead);
  element.onpointerdown = (event) => {
    const { left, width } = element.getBoundingClientRect();
    seek(((event.clientX - left) / width) * clip.duration);
  };
  return (time, segment) => {
    playhead.style.left = `${(Math.min(time, clip.duration) / clip.duration) * 100}%`;
    Array.from(segments.children).forEach((part, index) => part.classList.toggle("now", index === segment?.index));
  };
}

function row(name) {
  const element = document.createElement("div");
  element.className = name;
  return element;
}
