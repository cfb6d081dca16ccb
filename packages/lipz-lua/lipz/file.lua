--- The header and the directory of a file, and its sections.

local bytes = require("lipz.bytes")
local refuse = require("lipz.error")

local MAGIC = "\137LPZ\r\n\26\n"
local HEADER_BYTES, ENTRY_BYTES = 64, 16
local SECTION_COUNT_OFFSET = 40
local MOST_SECTIONS = 64
local FORMAT_MAJOR = 1

--- The sections that a bank must have, in their order, each with the bytes of an entry.
local BANK = {
  { "CLIP", 16 }, { "KEYS", 16 }, { "RATE", 16 }, { "PILT", 4 }, { "ORDR", 4 }, { "NAME", 1 }, { "FRAM", 1 },
  { "STRT", 4 }, { "LOCL", 8 }, { "TXST", 4 }, { "TEXT", 1 }, { "EVRF", 4 }, { "EVNT", 16 }, { "EVTY", 16 },
  { "EVNM", 8 }, { "EVST", 1 },
}
--- The sections of a text bank.
local TEXTS = { { "NAME", 1 }, { "LOCL", 8 }, { "TXST", 4 }, { "TEXT", 1 } }

local file = {}

local function check_header(data, whole)
  local start = data:sub(1, 4)
  if #data < HEADER_BYTES then
    if #data >= 4 and start ~= MAGIC:sub(1, 4) then return refuse("NotABank", 0) end
    return refuse("TooShort", #data)
  end
  if data:sub(1, 8) ~= MAGIC then
    return refuse(start == MAGIC:sub(1, 4) and "TextMode" or "NotABank", 0)
  end
  if bytes.u16(whole, 20) ~= FORMAT_MAJOR then return refuse("UnsupportedVersion", 20) end
  if bytes.u32(whole, 16) ~= #data then return refuse("WrongLength", 16) end
  local count = bytes.u32(whole, SECTION_COUNT_OFFSET)
  if count > MOST_SECTIONS then return refuse("DirectoryTooLong", SECTION_COUNT_OFFSET) end
  if HEADER_BYTES + count * ENTRY_BYTES > #data then return refuse("DirectoryOutOfBounds", SECTION_COUNT_OFFSET) end
  return count
end

--- Finds the sections, and checks that the `needed` ones are there in their order. The first section with a tag
-- counts.
local function find_sections(opened, count, needed)
  local next_needed, flags_offset = 1, 14
  for index = 0, count - 1 do
    local at = HEADER_BYTES + index * ENTRY_BYTES
    local tag = bytes.text(opened.whole, at, 4)
    local length = bytes.u32(opened.whole, at + 8)
    local section = bytes.part(opened.whole, bytes.u32(opened.whole, at + 4), length)
    if not section then return refuse("SectionOutOfBounds", at) end
    local is_required = bytes.u16(opened.whole, at + flags_offset) % 2 == 1
    local expected = needed[next_needed]
    if expected and expected[1] == tag then
      if bytes.u16(opened.whole, at + 12) ~= expected[2] or length % expected[2] ~= 0 then
        return refuse("SectionShape", at)
      end
      next_needed = next_needed + 1
      opened.sections[tag] = section
    elseif is_required then
      return refuse("SectionUnknown", at)
    else
      opened.sections[tag] = opened.sections[tag] or section
    end
  end
  if needed[next_needed] then return refuse("SectionMissing", SECTION_COUNT_OFFSET) end
  return opened
end

--- Opens a file from its bytes, a string. Returns a table with `whole` and `sections` (by tag, each with `data`,
-- `start` and `length`), or nil and an error. `has_texts_only` states whether the file is a text bank.
function file.open(data)
  local whole = { data = data, start = 0, length = #data }
  local count, message, problem = check_header(data, whole)
  if not count then return nil, message, problem end
  local has_texts_only = count > 0 and bytes.text(whole, HEADER_BYTES, 4) == "NAME"
  return { whole = whole, sections = {}, count = count, has_texts_only = has_texts_only }
end

--- Finds the sections of an open file: those of a text bank, or those of a bank.
function file.find(opened)
  return find_sections(opened, opened.count, opened.has_texts_only and TEXTS or BANK)
end

return file
