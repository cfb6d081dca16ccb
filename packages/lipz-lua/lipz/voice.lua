--- Voices: the clip to play for a line that was recorded in several languages.

local bytes = require("lipz.bytes")
local Bank = require("lipz.bank")
local Clip = require("lipz.clip")

local NO_DUB, DUB_OF, OTHER_DUB = 4294967295, 2147483648, 1073741824

--- Returns the tags of the voices, that of the originals first; an empty list without dubs.
function Bank:voices()
  if self.kept.voices then return self.kept.voices end
  local list = {}
  local section = self.sections.VOIC or bytes.EMPTY
  for tag in (bytes.text(section, 0, section.length)):gmatch("([^%z]*)%z") do list[#list + 1] = tag end
  self.kept.voices = list
  return list
end

--- Returns the entry of a clip in the table of a voice, from 2 on.
local function entry(bank, voice, slot)
  local at = ((voice - 2) * bank.clip_count + slot) * 4
  return slot < bank.clip_count and bytes.u32(bank.sections.DUBS or bytes.EMPTY, at) or NO_DUB
end

--- Returns the slot of a dub's original and the index of the dub's voice; nil for an original.
local function original_of(clip)
  for voice = 2, #clip.bank:voices() do
    local found = entry(clip.bank, voice, clip.slot)
    if found ~= NO_DUB and found >= DUB_OF then return found - DUB_OF, voice end
  end
  return nil
end

--- Returns the tag of the voice in which the clip is spoken; nil without dubs.
function Clip:voice()
  local _, voice = original_of(self)
  return self.bank:voices()[voice or 1]
end

--- Returns the clip of which this one is a dub; nil for an original.
function Clip:original()
  local slot = original_of(self)
  return slot and Clip.new(self.bank, slot)
end

--- Returns the clip to play in a voice, and the source of its visemes: "original", "dub" or "other dub", a dub in a
-- voice that this one falls back to.
function Clip:in_voice(tag)
  local original = self:original() or self
  for voice = 2, #self.bank:voices() do
    if self.bank:voices()[voice] == tag then
      local found = entry(self.bank, voice, original.slot)
      local is_other = found % DUB_OF >= OTHER_DUB
      local slot = is_other and found - OTHER_DUB or found
      local clip = found ~= NO_DUB and Clip.new(self.bank, slot)
      if clip then return clip, is_other and "other dub" or "dub" end
    end
  end
  return original, "original"
end

return Clip
