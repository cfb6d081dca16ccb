--- Events: the strings of segments, and the typed events that were parsed from them.

local bytes = require("lipz.bytes")
local u32 = bytes.u32

local RECORD_BYTES, NAME_BYTES = 16, 8
local NO_NAME = 4294967295

--- The verbs, each with whether it has an object: "name", "strength" (may be missing), or nil.
local VERBS = {
  { "feels", "name" }, { "sees", "name" }, { "stares", "name" }, { "stops staring" }, { "points", "name" },
  { "stops pointing" }, { "does", "name" }, { "nods", "strength" }, { "shakes", "strength" },
  { "breathes", "strength" }, { "blinks" }, { "looks away" },
}

local event = {}

--- A typed event: `verb`, and, where they are given, `character` and `object`. The object of `nods`, `shakes` and
-- `breathes` is a number from 0 to 10, as written in the file. `tostring` returns it in Character Event Syntax.
local Event = {}
Event.__index = Event

function Event.__tostring(self)
  local words = self.character and self.character .. " " .. self.verb or self.verb
  return self.object and words .. " " .. self.object or words
end

--- Returns the name with a number, or nil.
function event.name(bank, id)
  local at = id * NAME_BYTES
  local offset = u32(bank.sections.EVNM, at)
  return bytes.text(bank.sections.EVST, offset, u32(bank.sections.EVNM, at + 4))
end

--- Returns the number of a name, or nil. The first call reads all names.
function event.name_id(bank, name)
  local ids = bank.kept.name_ids
  if not ids then
    ids = {}
    for id = 0, bank.sections.EVNM.length / NAME_BYTES - 1 do
      local found = event.name(bank, id)
      if found then ids[found] = id end
    end
    bank.kept.name_ids = ids
  end
  return ids[name]
end

--- Returns the offset of the record of a segment, or nil if the clip has no events.
local function record(bank, number)
  local id = u32(bank.sections.EVRF, number * 4)
  if not id or (id + 1) * RECORD_BYTES > bank.sections.EVNT.length then return nil end
  return id * RECORD_BYTES
end

--- Returns the event string of the segment with a number.
function event.string(bank, number)
  local at = record(bank, number)
  if not at then return nil end
  return bytes.text(bank.sections.EVST, u32(bank.sections.EVNT, at), u32(bank.sections.EVNT, at + 4))
end

--- Returns the numbers of character and object (nil without one) and the verb of a typed event; nil if it is damaged.
local function typed(bank, index)
  local at = index * RECORD_BYTES
  local character, object = u32(bank.sections.EVTY, at), u32(bank.sections.EVTY, at + 4)
  local verb = VERBS[bytes.u8(bank.sections.EVTY, at + 8)]
  if not verb then return nil end
  local has_object = object ~= NO_NAME
  if has_object and (not verb[2] or not event.name(bank, object)) then return nil end
  if not has_object and verb[2] == "name" then return nil end
  if character ~= NO_NAME and not event.name(bank, character) then return nil end
  return verb[1], character ~= NO_NAME and character or nil, has_object and object or nil
end

--- Calls `see(verb, character_id, object_id)` for each typed event of the segment with a number.
function event.each(bank, number, see)
  local at = record(bank, number)
  if not at then return end
  local first, count = u32(bank.sections.EVNT, at + 8), u32(bank.sections.EVNT, at + 12)
  if (first + count) * RECORD_BYTES > bank.sections.EVTY.length then return end
  for index = first, first + count - 1 do
    local verb, character, object = typed(bank, index)
    if not verb then return end
    see(verb, character, object)
  end
end

--- Adds the typed events of the segment with a number to a list. Events without a character get `speaker`, a number of
-- a name or nil.
function event.collect(bank, number, speaker, list)
  event.each(bank, number, function(verb, character, object)
    character = character or speaker
    list[#list + 1] = setmetatable({
      verb = verb,
      character = character and event.name(bank, character),
      object = object and event.name(bank, object),
    }, Event)
  end)
  return list
end

return event
