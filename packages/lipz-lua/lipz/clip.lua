--- A clip: one spoken line. Frames and segments are numbered from 0.

local bytes = require("lipz.bytes")
local event = require("lipz.event")
local texts = require("lipz.texts")
local time = require("lipz.time")
local u64 = require("lipz.u64")
local u8, u16, u32 = bytes.u8, bytes.u16, bytes.u32

local CLIP_BYTES, KEY_BYTES, RATE_BYTES, RECORDING_BYTES = 16, 16, 16, 16
local MAX_INTEGER_FPS, NO_RATE = 1000, 65535
local NO_RECORDING_HALF = 4294967295
local VISEME_TYPES = { "blair", "toonboom", "rms" }

--- The string of each byte, so that a query does not create one.
local CHARACTERS = {}
for code = 0, 255 do CHARACTERS[code] = string.char(code) end
local REST = "-"

--- The openness of each viseme, from 0 to 9. All others are 0.
local OPENNESS = {
  blair = { A = 9, E = 6, O = 6, L = 4, S = 3, U = 2, W = 2, F = 1 },
  toonboom = { D = 9, C = 6, E = 6, B = 3, F = 2, G = 1 },
  rms = { ["1"] = 1, ["2"] = 2, ["3"] = 3, ["4"] = 4, ["5"] = 5, ["6"] = 6, ["7"] = 7, ["8"] = 8, ["9"] = 9 },
}
--- The openness of a digit: 1,100 ten-thousandths.
local OPENNESS_OF_DIGIT = 0.11

--- A clip, with `key`, `id` (16 hexadecimal digits), `frame_count`, `segment_count`, `viseme_type` (`blair`,
-- `toonboom`, `rms` or nil), `has_visemes`, `has_events`, and `fps_numerator` and `fps_denominator` (nil without a
-- rate).
local Clip = {}
Clip.__index = Clip

--- Returns the frame rate of a rate field, in lowest terms; nil without one.
local function rate_of(bank, rate)
  if rate == 0 or rate == NO_RATE then return nil end
  if rate <= MAX_INTEGER_FPS then return rate, 1 end
  local at = (rate - MAX_INTEGER_FPS - 1) * RATE_BYTES
  local numerator, denominator = u32(bank.sections.RATE, at + 8), u32(bank.sections.RATE, at + 12)
  if not denominator or denominator == 0 or numerator < denominator or numerator > denominator * MAX_INTEGER_FPS then
    return nil
  end
  return numerator, denominator
end

--- Returns the clip in a slot; nil if the bank does not have the slot.
function Clip.new(bank, slot)
  local sections = bank.sections
  local at, key_at = slot * CLIP_BYTES, slot * KEY_BYTES
  local frames_first = u32(sections.CLIP, at)
  local key_offset = u32(sections.KEYS, key_at + 8)
  if not frames_first or not key_offset then return nil end
  local clip = setmetatable({ bank = bank, slot = slot, kept = {} }, Clip)
  clip.frames_first = frames_first
  clip.frame_count = u32(sections.CLIP, at + 4)
  clip.segments_first = u32(sections.CLIP, at + 8)
  clip.fps_numerator, clip.fps_denominator = rate_of(bank, u16(sections.CLIP, at + 12))
  clip.viseme_type = VISEME_TYPES[u8(sections.CLIP, at + 14)]
  clip.has_visemes = u8(sections.CLIP, at + 15) % 2 == 1
  clip.has_events = clip.segments_first * 4 < sections.EVRF.length
  clip.id_low, clip.id_high = u32(sections.KEYS, key_at), u32(sections.KEYS, key_at + 4)
  clip.id = u64.hex(clip.id_high, clip.id_low)
  clip.key = bytes.text(sections.NAME, key_offset, u16(sections.KEYS, key_at + 12)) or ""
  clip.segment_count = math.min(u16(sections.KEYS, key_at + 14), math.floor(sections.STRT.length / 4))
  return clip
end

local function copy(clip)
  local other = setmetatable({}, Clip)
  for name, value in pairs(clip) do other[name] = value end
  other.kept = {}
  return other
end

--- Returns the clip with this frame rate, if its file does not specify one. The rate is between 1 and 1,000.
function Clip:or_fps(numerator, denominator)
  if self.fps_numerator then return self end
  local other = copy(self)
  other.fps_numerator, other.fps_denominator = numerator, denominator or 1
  return other
end

--- Returns the clip with this viseme type, if its file does not specify one.
function Clip:or_viseme_type(name)
  if self.viseme_type then return self end
  local other = copy(self)
  other.viseme_type = name
  return other
end

--- Returns the codes of all frames, one character each.
function Clip:frames() return bytes.text(self.bank.sections.FRAM, self.frames_first, self.frame_count) or "" end

--- Returns the length in seconds; nil without a frame rate.
function Clip:duration()
  local us = self:start_of_frame_us(self.frame_count)
  return us and us / 1000000
end

--- Returns the first microsecond of a frame; nil without a frame rate.
function Clip:start_of_frame_us(frame)
  if not self.fps_numerator then return nil end
  return time.start_of_frame_us(frame, self.fps_numerator, self.fps_denominator)
end

--- Returns the frame at a time; nil outside the clip.
function Clip:frame_at(at)
  if not self.fps_numerator then return nil end
  local frame = time.frame(at, self.fps_numerator, self.fps_denominator)
  return frame and frame < self.frame_count and frame or nil
end

--- Returns the viseme of a frame, one character; `-`, rest, outside the clip.
function Clip:viseme(frame)
  if not frame or frame < 0 or frame >= self.frame_count then return REST end
  return CHARACTERS[u8(self.bank.sections.FRAM, self.frames_first + frame)] or REST
end

--- Returns the viseme at a time.
function Clip:viseme_at(at) return self:viseme(self:frame_at(at)) end

--- Returns how far the mouth is open in a viseme, from 0 to 0.99; nil for clips without frames or viseme type.
function Clip:openness(viseme)
  local digits = OPENNESS[self.viseme_type]
  if not digits or self.frame_count == 0 then return nil end
  return (digits[viseme] or 0) * OPENNESS_OF_DIGIT
end

--- Returns the segment of a frame; nil outside the clip.
function Clip:segment_of_frame(frame)
  if not frame or frame < 0 or frame >= self.frame_count then return nil end
  local starts, offset = self.bank.sections.STRT, self.frames_first + frame
  local low, high = 0, self.segment_count - 1
  while low < high do
    local middle = math.floor((low + high) / 2)
    local next_start = u32(starts, (self.segments_first + middle + 1) * 4)
    if not next_start then return nil end
    if next_start <= offset then low = middle + 1 else high = middle end
  end
  return high >= 0 and low or nil
end

--- Returns the segment at a time; nil outside the clip.
function Clip:segment_at(at) return self:segment_of_frame(self:frame_at(at)) end

local function has_segment(clip, segment) return segment and segment >= 0 and segment < clip.segment_count end

--- Returns the first frame of a segment, and the frame after its last one; 0 and 0 outside the clip.
function Clip:segment_frames(segment)
  if not has_segment(self, segment) then return 0, 0 end
  local at = (self.segments_first + segment) * 4
  local first, last = u32(self.bank.sections.STRT, at), u32(self.bank.sections.STRT, at + 4)
  if not last then return 0, 0 end
  return math.max(first - self.frames_first, 0), math.max(last - self.frames_first, 0)
end

--- Returns the text of a segment in a locale of the bank, and whether it is from another locale; nil without a text,
-- and outside the clip.
function Clip:text(segment, locale)
  if not locale or not has_segment(self, segment) then return nil end
  return texts.find(locale, self.segments_first, self.segments_first + segment)
end

--- Returns the event string of a segment; nil without events, and outside the clip.
function Clip:event(segment)
  if not has_segment(self, segment) then return nil end
  return event.string(self.bank, self.segments_first + segment)
end

--- Returns the typed events of a segment, in order; an empty list outside the clip.
function Clip:events(segment)
  if not has_segment(self, segment) then return {} end
  return event.collect(self.bank, self.segments_first + segment, nil, {})
end

--- Returns the length in microseconds and the content hash (16 hexadecimal digits) of the recording that the clip was
-- made for; nil if the bank does not have them.
function Clip:recording()
  local section, at = self.bank.sections.RCRD or bytes.EMPTY, self.slot * RECORDING_BYTES
  local hash_high = u32(section, at + 12)
  if not hash_high then return nil end
  local low, high = u32(section, at), u32(section, at + 4)
  if high == NO_RECORDING_HALF and low == NO_RECORDING_HALF then return nil end
  return low + high * 4294967296, u64.hex(hash_high, u32(section, at + 8))
end

return Clip
