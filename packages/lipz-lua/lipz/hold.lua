--- Consonant hold: keeps consonants on the screen long enough to be seen (docs/guides/playback.md, lead and hold).

local CONSONANTS = {
  blair = { M = true, S = true, W = true, F = true, L = true },
  toonboom = { A = true, B = true, F = true, G = true },
  rms = {},
}
local MOST_FRAMES = 255

local hold = {}

--- Returns the frames of a hold that viewers can read: two frames at 24 frames per second.
function hold.readable(clip)
  local twelfths = 12 * clip.fps_denominator
  return math.min(math.floor((clip.fps_numerator + math.floor(twelfths / 2)) / twelfths), MOST_FRAMES)
end

--- Returns the frames of a hold that lasts one rendered frame of `rendered_frame_us` microseconds.
function hold.for_display(clip, rendered_frame_us)
  return math.min(math.ceil(rendered_frame_us * clip.fps_numerator / (clip.fps_denominator * 1000000)), MOST_FRAMES)
end

--- Counts the frames from `frame` in a direction that are vowels or rests, at most `most`.
local function open_frames(clip, consonants, frame, step, most)
  local count = 0
  while count < most and frame >= 0 and frame < clip.frame_count and not consonants[clip:viseme(frame)] do
    count, frame = count + 1, frame + step
  end
  return count
end

--- Returns the frames that the consonant at `frame` lacks, when its frames are counted in a direction.
local function missing(clip, frame, step, most)
  if frame < 0 or frame >= clip.frame_count then return 0 end
  local code, run = clip:viseme(frame), 0
  while run <= most and frame >= 0 and frame < clip.frame_count and clip:viseme(frame) == code do
    run, frame = run + 1, frame + step
  end
  return math.max(most - run, 0)
end

--- Returns the frame whose viseme is shown instead of that of `frame`.
function hold.shown(clip, viseme_type, frames, frame)
  local consonants = CONSONANTS[viseme_type]
  if frames < 2 or not consonants or frame >= clip.frame_count or consonants[clip:viseme(frame)] then return frame end
  local before = open_frames(clip, consonants, frame - 1, -1, frames)
  local behind = open_frames(clip, consonants, frame + 1, 1, frames)
  local spare = before + behind
  local missing_before = before < frames and missing(clip, frame - before - 1, -1, frames) or 0
  local taken_before = math.min(missing_before, spare)
  if before < taken_before then return frame - before - 1 end
  local after = frame + behind + 1
  local missing_behind = behind < frames and missing(clip, after, 1, frames) or 0
  local room = open_frames(clip, consonants, after + frames - missing_behind, 1, frames)
  local early = missing_behind - math.max(room - 1, 0)
  if behind < math.min(early, spare - taken_before) then return after end
  return frame
end

return hold
