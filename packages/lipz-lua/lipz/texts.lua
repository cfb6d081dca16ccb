--- Locales and texts, in a bank or in a text bank.

local bytes = require("lipz.bytes")
local u32 = bytes.u32

local LOCALE_BYTES = 8
local NO_TEXT = 4294967295
local TEXT_FALLBACK, TEXT_HAS_LENGTH = 2147483648, 1073741824
local COUNT_BYTES = 3

local texts = {}

--- A locale of a bank, with its `tag`, such as `en-us`, and `is_default`.
local Locale = {}
Locale.__index = Locale

--- Returns the locales of a file, in the order of their tags. `segment_count` is the number of segments in all clips.
function texts.locales(sections, segment_count)
  local list = {}
  for index = 0, sections.LOCL.length / LOCALE_BYTES - 1 do
    local at = index * LOCALE_BYTES
    local tag = bytes.text(sections.NAME, u32(sections.LOCL, at), bytes.u16(sections.LOCL, at + 4))
    list[#list + 1] = setmetatable({
      tag = tag or "",
      is_default = bytes.u16(sections.LOCL, at + 6) % 2 == 1,
      starts = sections.TXST,
      texts = sections.TEXT,
      first_entry = index * segment_count,
    }, Locale)
  end
  return list
end

--- Returns the offset and the length of the text of an entry, and whether it is from another locale.
local function place(locale, number)
  local entry = u32(locale.starts, (locale.first_entry + number) * 4)
  if not entry then return nil end
  local is_fallback = entry >= TEXT_FALLBACK
  entry = entry % TEXT_FALLBACK
  local offset = entry % TEXT_HAS_LENGTH
  if entry < TEXT_HAS_LENGTH then
    local next_entry = u32(locale.starts, (locale.first_entry + number + 1) * 4)
    if not next_entry then return nil end
    return offset, next_entry % TEXT_HAS_LENGTH - offset, is_fallback
  end
  local high, middle = bytes.u8(locale.texts, offset), bytes.u8(locale.texts, offset + 1)
  local low = bytes.u8(locale.texts, offset + 2)
  if not low then return nil end
  return offset + COUNT_BYTES, high % 64 * 4096 + middle % 64 * 64 + low % 64, is_fallback
end

--- Returns the text of the segment with a number, and whether it is from another locale; nil without a text. `first`
-- is the number of the clip's first segment.
function texts.find(locale, first, number)
  local entry = u32(locale.starts, (locale.first_entry + first) * 4)
  if not entry or entry == NO_TEXT then return nil end
  local offset, length, is_fallback = place(locale, number)
  local text = bytes.text(locale.texts, offset, length)
  if not text then return nil end
  return text, is_fallback
end

return texts
