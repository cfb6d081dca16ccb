--- A cursor: the position in a clip while it plays. It follows the audio, and returns each event once.

local event = require("lipz.event")
local hold = require("lipz.hold")
local state = require("lipz.state")
local time = require("lipz.time")
local Clip = require("lipz.clip")

local OVER = math.huge
local REST = "-"

--- The result if nothing is due, shared so that a rendered frame does not create a table. Do not change it.
local NOTHING = {}

--- A cursor, with `clip`, and with `is_over`, and `frame` (nil before the start and from the end on).
local Cursor = {}
Cursor.__index = Cursor

--- Returns a cursor before the start of the audio; nil without a frame rate. Settings:
-- `speaker`, the name of the character who speaks the clip; `lead_us`, by how much visemes are ahead of the audio;
-- `hold`, the least number of frames of a consonant, or "readable", or `{ rendered_frame_us = n }`.
function Clip:cursor(settings)
  if not self.fps_numerator then return nil, "the clip has no frame rate: set one with clip:or_fps" end
  local cursor = setmetatable({ clip = self, viseme_type = self.viseme_type }, Cursor)
  cursor.next_segment, cursor.is_over = 0, false
  settings = settings or NOTHING
  cursor:set_speaker(settings.speaker)
  cursor:set_lead_us(settings.lead_us or 0)
  cursor:set_hold(settings.hold or 0)
  return cursor
end

--- Sets the character to whom events without a character belong, by name; nil for none.
function Cursor:set_speaker(name) self.speaker = name and event.name_id(self.clip.bank, name) end

--- Sets by how many microseconds visemes are ahead of the audio. `lead_of(frames)` converts frames.
function Cursor:set_lead_us(us) self.lead_us = us end

--- Returns the microseconds of a number of frames, for `set_lead_us`.
function Cursor:lead_of(frames) return self.clip:start_of_frame_us(frames) end

--- Sets the hold of consonants, as in the settings.
function Cursor:set_hold(frames)
  if frames == "readable" then
    frames = hold.readable(self.clip)
  elseif type(frames) == "table" then
    frames = hold.for_display(self.clip, frames.rendered_frame_us)
  end
  self.hold_frames = frames
end

--- Continues at the same time in a new version of the clip, which may be from a different bank. Set the speaker again.
function Cursor:resume(clip)
  self.clip = clip:or_fps(self.clip.fps_numerator, self.clip.fps_denominator)
  self.speaker = nil
end

local function frame_at(cursor, at)
  local clip = cursor.clip
  local frame = time.frame(at, clip.fps_numerator, clip.fps_denominator)
  return frame and frame >= clip.frame_count and OVER or frame
end

local function show(cursor, at)
  cursor.place = frame_at(cursor, at)
  cursor.mouth = cursor.place
  if cursor.lead_us > 0 then cursor.mouth = frame_at(cursor, time.later(at, cursor.lead_us)) end
  cursor.is_over = cursor.place == OVER
  cursor.frame = cursor.place ~= OVER and cursor.place or nil
end

--- Returns the number of segments that have begun by a frame of the clip.
local function begun_by(clip, frame)
  local last = clip:segment_of_frame(frame)
  return last and last + 1 or 0
end

local function begun(cursor)
  if not cursor.place then return 0 end
  if cursor.is_over then return cursor.clip.segment_count end
  return begun_by(cursor.clip, cursor.place)
end

--- Returns the events of the segments from `first` up to `last`, then those up to `around_to`, and these segments.
local function due(cursor, first, last, around_to)
  if first >= last and around_to == 0 then return NOTHING, NOTHING end
  local clip, events, segments = cursor.clip, {}, {}
  local function add(segment)
    segments[#segments + 1] = segment
    event.collect(clip.bank, clip.segments_first + segment, cursor.speaker, events)
  end
  for segment = first, last - 1 do add(segment) end
  for segment = 0, around_to - 1 do add(segment) end
  return events, segments
end

--- Follows the audio to a time. Returns the typed events that are due, in order, and the segments that have begun,
-- each once, however long the rendered frame took. If nothing is due, both are the same empty table.
function Cursor:advance_to(at)
  local before, first = self.place, self.next_segment
  show(self, at)
  if self.place ~= before or not self.has_fired then
    self.next_segment = math.max(first, begun(self))
    self.has_fired = true
  end
  return due(self, first, self.next_segment, 0)
end

--- Follows audio that has looped from its end to its start. Returns what is due up to the end, then from the start.
function Cursor:loop_to(at)
  show(self, at)
  local first = self.next_segment
  self.next_segment, self.has_fired, self.has_looped = begun(self), true, true
  return due(self, first, self.clip.segment_count, self.next_segment)
end

--- Follows audio that has jumped. The next `advance_to` returns the events of the segments that start in this frame.
function Cursor:seek(at)
  show(self, at)
  local before = self.place and math.min(self.place, self.clip.frame_count) - 1
  self.next_segment = before and before >= 0 and begun_by(self.clip, before) or 0
  self.has_fired, self.has_looped = false, false
end

--- Ends the clip. Returns all remaining events and segments, so that lasting states take effect.
function Cursor:finish()
  self.place, self.mouth, self.frame, self.is_over = OVER, OVER, nil, true
  local first = self.next_segment
  self.next_segment, self.has_fired = self.clip.segment_count, true
  return due(self, first, self.next_segment, 0)
end

--- Returns the viseme to show, one character.
function Cursor:viseme()
  local mouth = self.mouth
  if not mouth or mouth >= self.clip.frame_count then return REST end
  if self.hold_frames < 2 then return self.clip:viseme(mouth) end
  return self.clip:viseme(hold.shown(self.clip, self.clip.viseme_type or self.viseme_type, self.hold_frames, mouth))
end

--- Returns how far the mouth is open, from 0 to 0.99; nil without frames or viseme type.
function Cursor:openness() return self.clip:openness(self:viseme()) end

--- Returns the segment at the position; nil before the start and from the end on.
function Cursor:segment() return self.clip:segment_of_frame(self.frame) end

--- Returns the subtitle at the position in a locale, and whether it is from another locale; nil without a text.
function Cursor:text(locale) return self.clip:text(self:segment(), locale) end

local function past(cursor)
  return { { 0, cursor.has_looped and cursor.clip.segment_count or 0 }, { 0, cursor.next_segment } }
end

--- Returns the `emotion` of a character (by name; nil for the speaker), and what the character `stares_at` and
-- `points_at`. A field is nil if no event has set it.
function Cursor:state(character)
  local id = character and event.name_id(self.clip.bank, character)
  if character and not id then return {} end
  return state.after(self.clip, past(self), self.speaker, id)
end

--- Returns a list with the state of each character in the clip's events, in the order of their names, with `name` (nil
-- for a speaker without a name).
function Cursor:characters()
  local list = {}
  for index, id in ipairs(state.characters(self.clip, self.speaker)) do
    local found = state.after(self.clip, past(self), self.speaker, id or nil)
    found.name = id and event.name(self.clip.bank, id) or nil
    list[index] = found
  end
  return list
end

return Cursor
