--- A bank: its clips, locales and names.

local bytes = require("lipz.bytes")
local event = require("lipz.event")
local file = require("lipz.file")
local refuse = require("lipz.error")
local texts = require("lipz.texts")
local time = require("lipz.time")
local u64 = require("lipz.u64")
local Clip = require("lipz.clip")
local u32 = bytes.u32

local KEY_BYTES, CLIP_BYTES = 16, 16
local WORD = 4294967296
local DIRECT_SLOT = 2147483648
local FINGERPRINT_OFFSET, SEED_OFFSET = 24, 32

--- An open bank, with `clip_count`.
local Bank = {}
Bank.__index = Bank

--- Opens a bank from its bytes, a string. Checks the header and the directory. Returns the bank, or nil, a message,
-- and a table with `kind`, `status` and `offset_bytes`.
function Bank.open(data)
  local opened, message, problem = file.open(data)
  if not opened then return nil, message, problem end
  if opened.has_texts_only then return refuse("TextsOnly", 0) end
  opened, message, problem = file.find(opened)
  if not opened then return nil, message, problem end
  local sections = opened.sections
  local bank = setmetatable({ whole = opened.whole, sections = sections, kept = {}, opened = opened }, Bank)
  bank.clip_count = math.floor(sections.CLIP.length / CLIP_BYTES)
  bank.segment_count = math.max(math.floor(sections.STRT.length / 4) - 1, 0)
  bank.all_locales = texts.locales(sections, bank.segment_count)
  return bank
end

--- Opens a text bank, the texts of more locales, from its bytes. Checks the header and the directory. Returns the bank,
-- or nil and an error.
function Bank:open_texts(data)
  local opened, message, problem = file.open(data)
  if not opened then return nil, message, problem end
  local fingerprint = bytes.text(opened.whole, FINGERPRINT_OFFSET, 8)
  if fingerprint ~= bytes.text(self.whole, FINGERPRINT_OFFSET, 8) then
    return refuse("OtherClips", FINGERPRINT_OFFSET)
  end
  opened, message, problem = file.find(opened)
  if not opened then return nil, message, problem end
  for _, locale in ipairs(texts.locales(opened.sections, self.segment_count)) do
    self.all_locales[#self.all_locales + 1] = locale
  end
  return self
end

--- Returns the high 32 bits of a product of two numbers of 32 bits.
local function scale(value, count) return (time.multiply_divide(value, count, WORD)) end

--- Returns the slot of an id, or nil.
local function find_slot(bank, high, low)
  local sections = bank.sections
  local seed_low, seed_high = u32(bank.whole, SEED_OFFSET), u32(bank.whole, SEED_OFFSET + 4)
  local spread_high, spread_low = u64.step(u64.xor32(high, seed_high), u64.xor32(low, seed_low))
  local slot = u32(sections.PILT, scale(spread_high, sections.PILT.length / 4) * 4)
  if not slot or bank.clip_count == 0 then return nil end
  if slot >= DIRECT_SLOT then
    slot = slot - DIRECT_SLOT
  else
    local mixed = u64.mul32(u64.xor32(spread_low, u64.mul32(slot, 0x9E3779B9)), 0x85EBCA6B)
    mixed = u64.mul32(u64.xor32(mixed, math.floor(mixed / 32768)), 0xC2B2AE35)
    slot = scale(mixed, bank.clip_count)
  end
  local at = slot * KEY_BYTES
  if u32(sections.KEYS, at) == low and u32(sections.KEYS, at + 4) == high then return slot end
  return nil
end

--- Returns the clip with a key, such as `act1/mara-good-evening`; nil if there is none.
function Bank:clip(key)
  local slot = find_slot(self, u64.clip_id(key))
  local clip = slot and Clip.new(self, slot)
  return clip and clip.key == key and clip or nil
end

--- Returns the clip with an index from 1 to `clip_count`, in the order of the keys; nil if there is none.
function Bank:clip_at(index)
  local slot = u32(self.sections.ORDR, (index - 1) * 4)
  return slot and Clip.new(self, slot)
end

--- Iterates over all clips, in the order of their keys.
function Bank:clips()
  local index = 0
  return function()
    index = index + 1
    return self:clip_at(index)
  end
end

--- Returns the locales, in the order of their tags, those of text banks last. Tags with `-x-` are variants of texts:
-- leave them out of a menu of languages.
function Bank:locales() return self.all_locales end

--- Returns the locale with a tag, such as `de-de`; nil if the bank does not have it.
function Bank:locale(tag)
  for _, locale in ipairs(self.all_locales) do
    if locale.tag == tag then return locale end
  end
  return nil
end

--- Returns the variant with this key, or with the longest beginning of it; nil if the bank has none.
local function variant_with_beginning(bank, locale, key)
  local names = key
  while names do
    local variant = bank:locale(locale.tag .. "-x-" .. names)
    if variant then return variant end
    names = names:match("^(.*)%-")
  end
  return nil
end

--- The plural categories of Unicode's CLDR, which come first in a key.
local PLURAL_CATEGORIES = { zero = true, one = true, two = true, few = true, many = true, other = true }

--- Returns the locale for texts of a variant: for `pl-pl` and the key `few`, the texts of `text_pl-pl-x-few` in Lipz
-- files. A key lists all cases that apply, the plural category first: `few`, or `few-fem`. The search removes names
-- from the end of the key (`few-fem`, `few`), and then does the same without the plural category (`fem`). If no clip
-- has any of these, the result is the locale itself. Look variants up once per locale.
function Bank:variant(locale, key)
  local variant = variant_with_beginning(self, locale, key)
  if variant then return variant end
  local first, rest = key:match("^(.-)%-(.*)$")
  if PLURAL_CATEGORIES[first] then variant = variant_with_beginning(self, locale, rest) end
  return variant or locale
end

--- Returns the project's default locale; nil without one.
function Bank:default_locale()
  for _, locale in ipairs(self.all_locales) do
    if locale.is_default then return locale end
  end
  return nil
end

--- Whether an event or a curve has this name.
function Bank:has_name(name) return event.name_id(self, name) ~= nil end

return Bank
