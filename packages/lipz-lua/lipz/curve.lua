--- Curves: named numbers that change while a clip plays. Inside this module, values are in thousandths.

local bytes = require("lipz.bytes")
local event = require("lipz.event")
local time = require("lipz.time")
local Clip = require("lipz.clip")
local u32 = bytes.u32

local RECORD_BYTES, UNIT_BYTES = 8, 4
local CURVE_WIDE = 2147483648
local EMPTY_LIST = {}

--- A curve of a clip, with `name` and `key_count`.
local Curve = {}
Curve.__index = Curve

--- Returns the index of the last record whose slot is at most `slot`, among records of two numbers in ascending order.
local function find_slot(section, slot)
  local count = math.floor(section.length / RECORD_BYTES)
  local low, high = 0, count
  while low < high do
    local middle = math.floor((low + high) / 2)
    if u32(section, middle * RECORD_BYTES) < slot then low = middle + 1 else high = middle end
  end
  return low < count and u32(section, low * RECORD_BYTES) == slot and low or nil
end
Curve.find_slot = find_slot

local function read_curve(clip, index)
  local sections = clip.bank.sections
  local at = index * RECORD_BYTES
  local first, name_and_width = u32(sections.CURV, at), u32(sections.CURV, at + 4)
  local section = sections.CRVK or bytes.EMPTY
  local last = u32(sections.CURV, at + RECORD_BYTES) or math.floor(section.length / UNIT_BYTES)
  local name = event.name(clip.bank, name_and_width % CURVE_WIDE)
  local keys = bytes.part(section, first * UNIT_BYTES, (last - first) * UNIT_BYTES)
  if not name or not keys then return nil end
  local is_wide = name_and_width >= CURVE_WIDE
  local key_bytes = is_wide and 8 or 4
  return setmetatable({
    clip = clip, name = name, keys = keys, is_wide = is_wide, key_bytes = key_bytes,
    key_count = math.floor(keys.length / key_bytes),
  }, Curve)
end

--- Returns all curves of the clip, in the order of their names.
function Clip:curves()
  if self.kept.curves then return self.kept.curves end
  local sections, list = self.bank.sections, {}
  local records = sections.CRVC or bytes.EMPTY
  local found = sections.CURV and find_slot(records, self.slot)
  if found then
    local count = math.floor(sections.CURV.length / RECORD_BYTES)
    local last = u32(records, found * RECORD_BYTES + 12) or count
    for index = u32(records, found * RECORD_BYTES + 4), math.min(last, count) - 1 do
      local curve = read_curve(self, index)
      if not curve then break end
      list[#list + 1] = curve
    end
  end
  self.kept.curves = list
  return list
end

--- Returns the curve with a name; nil if the clip does not have it.
function Clip:curve(name)
  for _, curve in ipairs(self:curves()) do
    if curve.name == name then return curve end
  end
  return nil
end

--- Returns the frame and the value in thousandths of a key, from 0.
function Curve:key_thousandths(index)
  local at = index * self.key_bytes
  if self.is_wide then return u32(self.keys, at), bytes.i32(self.keys, at + 4) end
  return bytes.u16(self.keys, at), bytes.i16(self.keys, at + 2)
end

--- Returns the frame and the value of a key, from 0 up to `key_count - 1`.
function Curve:key(index)
  local frame, thousandths = self:key_thousandths(index)
  return frame, thousandths and thousandths / 1000
end

--- Returns the index of the last key at or before a frame; 0 if there is none.
function Curve:index_at(frame)
  local low, high = 0, self.key_count - 1
  while low < high do
    local middle = math.ceil((low + high) / 2)
    if self:key_thousandths(middle) <= frame then low = middle else high = middle - 1 end
  end
  return low
end

--- Returns the value in thousandths at a frame and a part of it in 1/65,536.
function Curve:thousandths(frame, part)
  local index = self:index_at(frame)
  local before, value = self:key_thousandths(index)
  if not before or not value or frame < before then return value or 0 end
  local after, next_value = self:key_thousandths(index + 1)
  if not after or not next_value or after <= frame then return value or 0 end
  local distance, whole = math.abs(next_value - value), (after - before) * 65536
  local done, rest = time.multiply_divide((frame - before) * 65536 + part, distance, whole)
  if rest * 2 >= whole then done = done + 1 end
  return next_value > value and value + done or value - done
end

--- Returns the value at the start of a frame.
function Curve:value(frame) return self:thousandths(frame, 0) / 1000 end

--- Returns the value at a time; nil without a frame rate.
function Curve:value_at(at)
  local clip = self.clip
  if not clip.fps_numerator then return nil end
  return self:thousandths(time.position(at, clip.fps_numerator, clip.fps_denominator)) / 1000
end

--- Returns the curves of a character, each as `curve` and `purpose`, its name without that of the character. `who` is
-- nil for the speaker, `{ speaker = name }` for a speaker whom events name, or the name of a different character.
function Clip:curves_of(who)
  if #self:curves() == 0 then return EMPTY_LIST end
  local character = type(who) == "table" and who.speaker or who
  local is_speaker = type(who) ~= "string"
  local kept_name = (is_speaker and "speaker " or "other ") .. (character or "")
  if self.kept[kept_name] then return self.kept[kept_name] end
  local list, prefix = {}, character and character .. "."
  for _, curve in ipairs(self:curves()) do
    local is_named = prefix and curve.name:sub(1, #prefix) == prefix
    if is_named then
      list[#list + 1] = { curve = curve, purpose = curve.name:sub(#prefix + 1) }
    elseif is_speaker then
      list[#list + 1] = { curve = curve, purpose = curve.name }
    end
  end
  self.kept[kept_name] = list
  return list
end

--- Of two values, returns the one that is farther from neutral.
function Curve.farther(one, other, neutral)
  return math.abs(other - neutral) > math.abs(one - neutral) and other or one
end

return Curve
