--- The damaged banks of fixtures/banks/damaged.txt: each must give the documented error, and no query of a bank that
-- opens may raise an error.

local files = require("test.files")
local lipz = require("lipz")
local u64 = require("lipz.u64")
local unpack = table.unpack or unpack

local FEATURES = { ["text-banks"] = true, checksum = true }
--- Every query of a bank with a changed byte takes long, so only some of these banks get them.
local QUERIED_EACH = 29

local case

local function put(bytes, at, hex)
  local new = hex:gsub("%x%x", function(digits) return string.char(tonumber(digits, 16)) end)
  return bytes:sub(1, at) .. new .. bytes:sub(at + #new + 1)
end

--- Returns the offset of the directory entry of a section of an undamaged file, and the offset of the section.
local function find(bytes, tag)
  for at = 64, #bytes - 16, 16 do
    if bytes:sub(at + 1, at + 4) == tag then
      local a, b, c, d = bytes:byte(at + 5, at + 8)
      return at, a + b * 256 + c * 65536 + d * 16777216
    end
  end
end

local function damaged(bytes)
  local undamaged = bytes
  for _, words in ipairs(case.damage) do
    local at = tonumber(words[2])
    if words[1] == "cut" then bytes = bytes:sub(1, at)
    elseif words[1] == "append" then bytes = put(bytes, #bytes, words[2])
    elseif words[1] == "put" then bytes = put(bytes, at, words[3])
    elseif words[1] == "entry" then bytes = put(bytes, (find(undamaged, words[2])) + tonumber(words[3]), words[4])
    elseif words[1] == "section" then
      bytes = put(bytes, select(2, find(undamaged, words[2])) + tonumber(words[3]), words[4])
    end
  end
  return bytes
end

--- Makes every query. Returns how many clips it has seen.
local function query(bank)
  local count = 0
  bank:clip("act1/blair")
  bank:default_locale()
  for clip in bank:clips() do
    count = count + 1
    local rated = clip:or_fps(24):or_viseme_type("blair")
    rated:frames()
    rated:recording()
    rated:in_voice("de-de")
    rated:voice()
    for segment = 0, math.min(clip.segment_count, 20) - 1 do
      clip:segment_frames(segment)
      clip:event(segment)
      clip:events(segment)
      for _, locale in ipairs(bank:locales()) do clip:text(segment, locale) end
    end
    local cursor = rated:cursor({ speaker = "amy", hold = 3, lead_us = 40000 })
    for us = 0, 400000, 100000 do
      local at = { us = us }
      cursor:advance_to(at)
      cursor:viseme()
      cursor:openness()
      rated:emotions_at(at, "mara")
      for _, curve in ipairs(rated:curves()) do curve:value_at(at) end
      for _, rig in ipairs(bank:rigs()) do rated:weights_at(at, rig) end
    end
    rated:face_at({ us = 0 })
    rated:articulation_at({ us = 0 })
    cursor:loop_to(0)
    cursor:finish()
    cursor:characters()
  end
  bank:default_babble():at(1, 0.5)
  for _, babble in ipairs(bank:babbles()) do babble:at(1, 0.5) end
  bank:articulations()
  return count
end

local function said(bank, _, problem)
  return bank and "opens" or ("%s at %d"):format(problem.kind, problem.offset_bytes)
end

local function fnv(lines)
  local high, low = 0xCBF29CE4, 0x84222325
  for at = 1, #lines do high, low = u64.mul(high, u64.xor32(low, lines:byte(at)), 0x100, 0x1B3) end
  return u64.hex(high, low)
end

local function each_byte(bytes)
  local opened, refused, lines = 0, 0, {}
  for at = 0, #bytes - 1 do
    local changed = bytes:sub(1, at) .. string.char(255 - bytes:byte(at + 1)) .. bytes:sub(at + 2)
    local bank, message, problem = lipz.open(changed)
    if bank then
      opened = opened + 1
      if at % QUERIED_EACH == 0 then query(bank) end
    else
      refused = refused + 1
      lines[refused] = ("%d: %s\n"):format(at, said(bank, message, problem))
    end
  end
  return ("%d open, %d refused, fnv %s"):format(opened, refused, fnv(table.concat(lines)))
end

local function answer(words)
  local bytes = damaged(case.bytes)
  if words[1] == "open" then
    local bank, message, problem = lipz.open(bytes)
    if bank then query(bank) end
    return said(bank, message, problem)
  elseif words[1] == "verify" then
    local bank, message, problem = assert(lipz.open(bytes)):verify_checksum()
    return bank and "verified" or said(bank, message, problem)
  elseif words[1] == "texts" then
    return said(assert(lipz.open(case.bytes)):open_texts(damaged(files.golden(words[2] .. ".lipztexts"))))
  elseif words[1] == "each-byte" then
    return each_byte(bytes)
  end
  return nil
end

--- Changed words in sections that only `verify` of other readers checks. Queries may return anything, but not raise.
local UNVERIFIED = {
  { "curves", "CURV", "section", 28, "00000080" },
  { "curves", "CURV", "section", 8, "01000000" },
  { "specials", "CURV", "section", 100, "00000080" },
  { "phones", "PHNC", "entry", 8, "04000000" },
  { "phones", "PHNC", "entry", 8, "14000000" },
  { "long", "BABL", "section", 17, "0000" },
}

local function query_unverified()
  for _, row in ipairs(UNVERIFIED) do
    local name, tag, place, offset, new = unpack(row)
    case = { bytes = files.golden(name .. ".lipzbank"), damage = { { place, tag, tostring(offset), new } } }
    local bank = lipz.open(damaged(case.bytes))
    if bank then query(bank) end
  end
end

--- Opens all damaged banks. Returns the number of commands that were run and skipped, and an error message or nil.
return function()
  local expected = files.read("fixtures/banks/damaged.txt")
  local answers, run, skipped, is_skipping = {}, 0, 0, false
  for _, line in ipairs(files.lines(expected)) do
    local is_answer = line:sub(1, 2) == "  "
    if not is_answer or is_skipping then answers[#answers + 1] = line end
    local words = files.words(line)
    if line:sub(1, 2) == "##" then is_skipping = false end
    if words[1] == "needs" then
      for index = 2, #words do is_skipping = is_skipping or not FEATURES[words[index]] end
    elseif not is_answer and line ~= "" and line:sub(1, 1) ~= "#" then
      if is_skipping then
        skipped = skipped + 1
      else
        run = run + 1
        if words[1] == "bank" then
          case = { bytes = files.golden(words[2] .. ".lipzbank"), damage = {} }
        else
          local found = answer(words)
          if found then answers[#answers + 1] = "  " .. found else case.damage[#case.damage + 1] = words end
        end
      end
    end
  end
  query_unverified()
  return run, skipped, files.difference("damaged.txt", table.concat(answers, "\n") .. "\n", expected)
end
