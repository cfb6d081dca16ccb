--- Phones: the units of speech in a clip, and their times.

local bytes = require("lipz.bytes")
local Clip = require("lipz.clip")
local Curve = require("lipz.curve")
local u8, u16, u32 = bytes.u8, bytes.u16, bytes.u32

local RECORD_BYTES = 8
local WIDE, CERTAIN = 2147483648, 1073741824
local NO_LEVEL = 128
--- The length of the last phone of a clip without frames.
local LAST_MS = 100

--- The phones of a clip, with `count`, `are_certain`, and `level_db`, the level of the speech (nil if it is unknown).
local Phones = {}
Phones.__index = Phones

local NONE = setmetatable({ count = 0, are_certain = true }, Phones)

--- Returns the number of a phone and its start in milliseconds; nil after the last one. The first is 0.
function Phones:start(index)
  if index < 0 or index >= self.count then return nil end
  local at = 1 + index * self.entry_bytes
  local start_ms = self.is_wide and u32(self.section, at + 1) or u16(self.section, at + 1)
  return u8(self.section, at), start_ms
end

--- Returns the end of a phone in milliseconds.
function Phones:end_ms(index)
  local _, next_ms = self:start(index + 1)
  return next_ms or self.clip_end_ms
end

--- Returns the number of phones that start by a time in milliseconds.
function Phones:started_by(ms)
  local low, high = 0, self.count
  while low < high do
    local middle = math.floor((low + high) / 2)
    local _, start_ms = self:start(middle)
    if start_ms <= ms then low = middle + 1 else high = middle end
  end
  return low
end

local function read(clip, records, index)
  local data = clip.bank.sections.PHON or bytes.EMPTY
  local flags = u32(records, index * RECORD_BYTES + 4)
  local next_flags = u32(records, (index + 1) * RECORD_BYTES + 4)
  local first = flags % CERTAIN
  local last = next_flags and next_flags % CERTAIN or data.length
  local section = bytes.part(data, first, last - first) or bytes.EMPTY
  local level = u8(section, 0) or NO_LEVEL
  local is_wide = flags >= WIDE
  local entry_bytes = is_wide and 5 or 3
  local phones = setmetatable({
    section = section, is_wide = is_wide, entry_bytes = entry_bytes,
    are_certain = flags % WIDE >= CERTAIN,
    level_db = level ~= NO_LEVEL and (level < 128 and level or level - 256) or nil,
    count = math.max(math.floor((section.length - 1) / entry_bytes), 0),
  }, Phones)
  local _, last_ms = phones:start(phones.count - 1)
  if clip.frame_count > 0 and clip.fps_numerator then
    phones.clip_end_ms = math.floor(clip:start_of_frame_us(clip.frame_count) / 1000)
  else
    phones.clip_end_ms = (last_ms or 0) + LAST_MS
  end
  return phones
end

--- Returns the phones of the clip.
function Clip:phones()
  if self.kept.phones then return self.kept.phones end
  local records = self.bank.sections.PHNC or bytes.EMPTY
  local index = Curve.find_slot(records, self.slot)
  self.kept.phones = index and read(self, records, index) or NONE
  return self.kept.phones
end

return Phones
